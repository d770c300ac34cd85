"""``Robot``: two motors, by the names of the JetBot library."""

import atexit
import contextlib
import os
import threading
from typing import Any, Optional, Union

from .boards import DEFAULT_PORT, find_board
from .errors import BusError, InvalidValue, JetbotError
from .guard import Guard
from .motor import Motor, finite, turn_cut_off


class Robot:
    """A JetBot's two wheels. They stop when the interpreter exits, and when its process is killed.

    board: a name in ``boards.BOARDS``; i2c_bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; port: of a jetbot_pro.
    The defaults are JETBOT_BOARD, JETBOT_I2C_BUS and JETBOT_PORT, else ``jetbot``, 1 and /dev/ttyACM0.
    left_motor_alpha, right_motor_alpha: trims, finite numbers, for a robot that does not drive straight.
    swap_motors, invert_left, invert_right: for a robot whose motors are wired differently.
    min_duty: smallest duty, in [0, 1), that turns a wheel; speeds above 0 start there.

    Speeds are in [-1, 1], 1 full forward, and clamped to that; a JetBot Pro takes m/s instead, up to 32.767. A speed
    that is not a finite number stops both wheels and raises InvalidValue (a ValueError); so does a bad option. A board
    that does not answer raises BusError (an OSError), and is set up again by the next call. The methods may be called
    from any thread and any signal handler.
    """

    _open = []  # every Robot that is not closed

    def __init__(self, board: Optional[str] = None, i2c_bus: Union[int, str, None] = None, port: Optional[str] = None,
                 left_motor_alpha: float = 1.0, right_motor_alpha: float = 1.0, swap_motors: bool = False,
                 invert_left: bool = False, invert_right: bool = False, min_duty: float = 0.0):
        board = (os.environ.get("JETBOT_BOARD") or "jetbot") if board is None else board
        i2c_bus = (os.environ.get("JETBOT_I2C_BUS") or 1) if i2c_bus is None else i2c_bus
        port = (os.environ.get("JETBOT_PORT") or DEFAULT_PORT) if port is None else port
        self.left_motor = Motor(self, left_motor_alpha, invert_left, min_duty)
        self.right_motor = Motor(self, right_motor_alpha, invert_right, min_duty)
        self._outputs = (self.right_motor, self.left_motor) if swap_motors else (self.left_motor, self.right_motor)
        self._speeds = dict.fromkeys(self._outputs, 0.0)
        self._lock = threading.RLock()  # a signal handler may come in between, in the same thread
        self._closed = False
        place = find_board(board).place(i2c_bus, port)
        self.driver = find_board(board).open(place)
        self._close_predecessors()
        self._guard = Guard(board, place)
        Robot._open.append(self)

    def set_motors(self, left_speed: float, right_speed: float) -> None:
        """Drive both wheels at these speeds."""
        self._set_speeds({self.left_motor: left_speed, self.right_motor: right_speed})

    def forward(self, speed: float = 1.0) -> None:
        """Drive straight forward."""
        self.set_motors(speed, speed)

    def backward(self, speed: float = 1.0) -> None:
        """Drive straight backward."""
        self.set_motors(negated(speed), negated(speed))

    def left(self, speed: float = 1.0) -> None:
        """Turn left on the spot."""
        self.set_motors(negated(speed), speed)

    def right(self, speed: float = 1.0) -> None:
        """Turn right on the spot."""
        self.set_motors(speed, negated(speed))

    def stop(self) -> None:
        """Stop both motors; they coast."""
        self.set_motors(0, 0)

    def verify(self) -> None:
        """Read back a part of what the board holds, in one transfer, and restore what it lost."""
        with self._lock:
            self._apply(self.driver.verify)

    def keep_alive(self) -> None:
        """Feed the watchdogs: the guard, and the board's own timer.

        Once called, it must be called again within a second, or the wheels stop; ``driver.keep_alive_interval`` is how
        often the board wants it.
        """
        with self._lock:
            self._apply(self._guard.heartbeat, self.driver.keep_alive)

    def close(self) -> None:
        """Stop the wheels and release the board. May be called twice.

        Raises BusError if the board does not answer; the guard then keeps trying for ten minutes.
        """
        with self._lock:
            if self._closed:
                return
            self._closed = True
            self._speeds.update(dict.fromkeys(self._outputs, 0.0))  # for the command that a signal handler interrupts
            try:
                self.driver.drive(0, 0)
                self._guard.dismiss()
            finally:
                Robot._open.remove(self)
                self._guard.leave()
                self.driver.close()

    guarded = True

    @property
    def at_full_power(self) -> bool:
        """Whether both wheels are at full power, the same way, so that the turn which was commanded is cut off."""
        return turn_cut_off(self.left_motor, self.right_motor, self.driver)

    def _set_speeds(self, speeds):
        """Drive the wheels in ``speeds``, a dict of Motor: speed; the others keep theirs."""
        with self._lock:
            try:
                speeds = {motor: finite(speed, "a speed") for motor, speed in speeds.items()}
            except InvalidValue:
                self.stop()
                raise
            self._speeds.update(speeds)  # both at once: a signal handler may come at any moment
            self._apply()

    def _apply(self, *actions):
        """Run the actions, then drive both motors."""
        if self._closed:
            raise JetbotError("this robot is closed", "Make a new Robot().")
        done = None
        while done != (wanted := [motor.output(self.driver) for motor in self._outputs]):
            for action in actions:
                action()
            self.driver.drive(*wanted)
            done = wanted  # unless a signal handler has set other speeds meanwhile

    def _close_predecessors(self):
        """Close earlier Robots on the same board, such as a notebook's cell leaves behind when it is run again."""
        link = self.driver.link
        for other in list(Robot._open):
            if (other.driver.link.name, other.driver.link.address) == (link.name, link.address):
                other._close_quietly()

    def _close_quietly(self):
        with contextlib.suppress(BusError):  # the guard reports it
            self.close()

    def _detach(self):
        """In a forked child: the wheels are the parent's, and so is the end of the pipe to the guard."""
        self._lock = threading.RLock()  # another thread may have held the old one
        self._closed = True
        self._guard.leave()

    def __enter__(self) -> "Robot":
        return self

    def __exit__(self, *_):
        self.close()


def close_all() -> None:
    """At the interpreter's end: stop the wheels of every Robot."""
    for robot in list(Robot._open):
        robot._close_quietly()


def detach_all() -> None:
    """In a forked child: leave every Robot to the parent."""
    for robot in Robot._open:
        robot._detach()
    Robot._open.clear()


atexit.register(close_all)
os.register_at_fork(after_in_child=detach_all)


def negated(speed: Any) -> Any:
    """Return -speed; what cannot be negated is returned as it is, for ``finite`` to refuse."""
    try:
        return -speed
    except TypeError:
        return speed
