"""``Robot``: two motors, by the names of the JetBot library."""

import atexit
import contextlib
import os
import threading
import time
from typing import Callable, Dict, Iterable, List, Optional, Tuple, Type, Union

from .boards import DEFAULT_PORT, DEFAULT_PWM_FREQUENCY, find_board
from .connection import locate, open_board
from .errors import GuardError, InvalidValue, JetbotError
from .guard import PING_INTERVAL, Guard, NoGuard
from .kinds import BOOLEAN, FINITE, PWM_FREQUENCY
from .motor import Motor, is_cut_off

STOPPED = (0.0, 0.0)  # what the driver is given for two motors that are off


class Robot:
    """A JetBot's two wheels. They stop when the interpreter exits, and when its process is killed.

    board: a name in ``boards.BOARDS``; i2c_bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; port: of a jetbot_pro.
    The defaults are JETBOT_BOARD, JETBOT_I2C_BUS and JETBOT_PORT, else ``jetbot``, 1 and /dev/ttyACM0.
    i2c_address: 0x03 to 0x77, of a board whose jumpers or switches change it.
    left_motor_alpha, right_motor_alpha: trims, finite numbers, for a robot that does not drive straight.
    swap_motors, invert_left, invert_right: for a robot whose motors are wired differently.
    min_duty, max_duty: the duties that speeds in (0, 1] map onto: the smallest that turns a wheel, and the largest.
    pwm_frequency: of the duties, in Hz, 24 to 1526.
    guard: False drives without the second process that stops the wheels if this one is killed.

    Speeds are in [-1, 1], 1 full forward, and clamped to that; a JetBot Pro takes m/s instead, up to 32.767. A speed
    that is not a finite number stops both wheels and raises InvalidValue (a ValueError); so does a bad option. A board
    that does not answer raises BusError (an OSError), and is set up again by the next call. The wheels turn only while
    the guard is up: the first command waits for it, up to 10 s, then raises GuardError. The methods may be called from
    any thread and any signal handler.
    """

    motor_class: Type[Motor] = Motor

    def __init__(self, board: Optional[str] = None, i2c_bus: Union[int, str, None] = None, port: Optional[str] = None,
                 left_motor_alpha: float = 1.0, right_motor_alpha: float = 1.0, swap_motors: bool = False,
                 invert_left: bool = False, invert_right: bool = False, min_duty: float = 0.0,
                 guard: bool = True, *, max_duty: float = 1.0, i2c_address: Union[int, str, None] = None,
                 pwm_frequency: float = DEFAULT_PWM_FREQUENCY):
        board = (os.environ.get("JETBOT_BOARD") or "jetbot") if board is None else board
        i2c_bus = (os.environ.get("JETBOT_I2C_BUS") or 1) if i2c_bus is None else i2c_bus
        port = (os.environ.get("JETBOT_PORT") or DEFAULT_PORT) if port is None else port
        for name, value in ("swap_motors", swap_motors), ("invert_left", invert_left), ("invert_right", invert_right):
            BOOLEAN.check(f"the option {name}", value)
        PWM_FREQUENCY.check("the pwm_frequency", pwm_frequency)
        self._speeds: Dict[Motor, float] = {}  # as they were commanded
        self.left_motor, self.right_motor = (
            self.motor_class(self._speeds, self.command, alpha, inverted, min_duty, max_duty)
            for alpha, inverted in ((left_motor_alpha, invert_left), (right_motor_alpha, invert_right)))
        self._outputs = (self.right_motor, self.left_motor) if swap_motors else (self.left_motor, self.right_motor)
        self._given: Optional[Tuple[float, ...]] = None  # what the driver holds, as of ``_outputs``; None: not known
        self._lock = threading.RLock()  # a signal handler may come in between, in the same thread
        self.resumes = True  # False: a board that has lost its speeds is left stopped until the next command
        self._closed = False
        self._watched = not guard  # whether the loss of the guard would be noticed
        row = find_board(board, i2c_address)
        place = locate(row, i2c_bus, port)
        self.driver = open_board(row, place, pwm_frequency)
        try:
            self._guard = Guard(board, place, row.address) if guard else NoGuard()
        except GuardError:
            self.driver.close()
            raise
        link = self.driver.link
        close_all(robot for robot in open_robots if (robot.driver.link.name, robot.driver.link.address)
                  == (link.name, link.address))  # such as a notebook's cell leaves behind when it is run again
        open_robots.append(self)

    def set_motors(self, left_speed: float, right_speed: float) -> None:
        """Drive both wheels at these speeds."""
        self.command({self.left_motor: left_speed, self.right_motor: right_speed})

    def forward(self, speed: float = 1.0) -> None:
        """Drive straight forward."""
        self.set_motors(speed, speed)

    def backward(self, speed: float = 1.0) -> None:
        """Drive straight backward."""
        self.forward(-self._checked(speed))

    def left(self, speed: float = 1.0) -> None:
        """Turn left on the spot."""
        self.set_motors(-self._checked(speed), speed)

    def right(self, speed: float = 1.0) -> None:
        """Turn right on the spot."""
        self.set_motors(speed, -self._checked(speed))

    def stop(self) -> None:
        """Stop both motors; they coast."""
        self.set_motors(0, 0)

    def verify(self) -> None:
        """Read back a part of what the board holds, in one transfer, and restore what it lost."""
        with self._lock:
            self._update(self.driver.verify)

    def keep_alive(self) -> None:
        """Feed the watchdogs: the guard, and the board's own timer.

        Once called, it must be called again within a second, or the wheels stop; ``driver.keep_alive_interval`` is how
        often the board wants it.
        """
        self._watched = True
        with self._lock:
            try:
                self._update(self.driver.keep_alive)
            finally:
                if not self._closed:
                    self._guard.heartbeat()

    def close(self) -> None:
        """Stop the wheels and release the board. May be called twice.

        Raises BusError if the board does not answer; the guard then keeps trying for ten minutes.
        """
        with self._lock:
            if self._closed:
                return
            self._closed = True
            self._clear_speeds()  # for the command that a signal handler interrupts
            self._given = None
            try:
                self.driver.drive(0, 0)
                self._guard.dismiss()
            finally:
                if self in open_robots:
                    open_robots.remove(self)
                self._guard.leave()
                self.driver.close()

    def detach(self) -> None:
        """In a forked child: the wheels are the parent's, and so is the connection to the guard."""
        self._lock = threading.RLock()  # another thread may have held the old one
        self._closed = True
        self._guard.leave()

    @property
    def guarded(self) -> bool:
        """Whether the guard is known to be up; always True without one by choice. No wheel turns while it is False."""
        with self._lock:
            return self._guard.is_up()

    @property
    def duties(self) -> Tuple[float, float]:
        """What the wheels (left, right) are given now: duties in [-1, 1], of a closed loop m/s; 0 if not known."""
        duties = {motor: motor.duty_of(given) for motor, given in zip(self._outputs, self._given or STOPPED)}
        return duties[self.left_motor], duties[self.right_motor]

    @property
    def at_full_power(self) -> bool:
        """Whether both wheels are at full power, or max_duty, the same way, and a turn or more speed was commanded."""
        return is_cut_off(self.left_motor, self.right_motor, self.driver)

    def command(self, speeds: Dict[Motor, float]) -> None:
        """Drive these wheels at new speeds; the other one keeps its own. Wait for the guard, with stopped wheels."""
        speeds = {motor: self._checked(speed) for motor, speed in speeds.items()}
        if any(speeds.values()) and not self._watched:
            threading.Thread(target=self._watch_guard, daemon=True).start()
            self._watched = True
        self._speeds.update(speeds)  # both at once: a signal handler or another thread may come at any moment
        with self._lock:
            if not self._update():
                self._wait_for_guard()

    def _checked(self, speed: float) -> float:
        """Return the speed as a float; stop both wheels and raise InvalidValue for anything but a finite number."""
        try:
            FINITE.check("a speed", speed)
        except InvalidValue:
            self.stop()
            raise
        return float(speed)

    def _wait_for_guard(self) -> None:
        try:
            self._guard.wait(self._is_commanded)
        except GuardError:
            self._clear_speeds()
            raise
        self._update()

    def _watch_guard(self) -> None:
        """Stop the wheels of a program that only waits when its guard is lost; the next command replaces that."""
        while not self._closed:
            time.sleep(PING_INTERVAL)
            with contextlib.suppress(JetbotError), self._lock:
                if not (self._closed or self._guard.is_up()):
                    self._update()

    def _update(self, action: Callable[[], None] = lambda: None) -> bool:
        """Run the action, then give the driver the speeds that are commanded, or 0 if there is no guard.

        Returns whether the wheels may turn. A board that already holds these speeds is sent nothing.
        """
        if self._closed:
            raise JetbotError("this robot is closed", "Make a new Robot().")
        commanded, permitted = None, True
        while commanded != list(self._speeds.values()):  # again if a signal handler has set other speeds meanwhile
            action()
            if not (self.resumes or self.driver.in_sync):
                self._clear_speeds()
            commanded = list(self._speeds.values())
            permitted = not any(commanded) or self._guard.is_up()
            outputs = tuple(motor.output(self.driver) for motor in self._outputs) if permitted else STOPPED
            if outputs != self._given or not self.driver.in_sync:
                self._given = None  # until it went through
                self.driver.drive(*outputs)
                self._given = outputs
        return permitted

    def _is_commanded(self) -> bool:
        return any(self._speeds.values())

    def _clear_speeds(self) -> None:
        self._speeds.update(dict.fromkeys(self._outputs, 0.0))

    def __enter__(self) -> "Robot":
        return self

    def __exit__(self, *_: object) -> None:
        self.close()


open_robots: List[Robot] = []  # of this process; the last one of a board


def close_all(robots: Iterable[Robot]) -> None:
    """Close robots; those whose boards do not answer are left to their guards."""
    for robot in list(robots):
        with contextlib.suppress(JetbotError):
            robot.close()


def detach_all() -> None:
    """In a forked child: leave every Robot to the parent."""
    for robot in open_robots:
        robot.detach()
    open_robots.clear()


atexit.register(close_all, open_robots)
os.register_at_fork(after_in_child=detach_all)
