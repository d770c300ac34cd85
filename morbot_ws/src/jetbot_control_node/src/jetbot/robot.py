"""``Robot``: two motors, by the names of the JetBot library."""

import atexit
import contextlib
import math
import os
import threading

from .boards import PORT, Options, open_board
from .errors import BusError, InvalidValue, JetbotError
from .guard import Guard
from .kinematics import clamp


class Motor:
    """One wheel of a Robot; see there for alpha, inverted and min_duty."""

    def __init__(self, robot, alpha, inverted, min_duty):
        self._robot = robot
        self._inverted = inverted
        self._min_duty = finite(min_duty, "min_duty")
        self.alpha = alpha
        if not 0 <= self._min_duty < 1:
            raise InvalidValue(f"min_duty must be at least 0 and below 1, not {min_duty!r}")

    @property
    def value(self):
        """The speed last set, in [-1, 1], 1 full forward. Setting it drives the wheel, clamped to that range."""
        return self._robot._speeds[self]

    @value.setter
    def value(self, speed):
        self._robot._set_speeds({self: speed})

    @property
    def alpha(self):
        """A trim that the speed is multiplied with from the next command on; a finite number."""
        return self._alpha

    @alpha.setter
    def alpha(self, alpha):
        self._alpha = finite(alpha, "an alpha")

    @property
    def output(self):
        """What the motor is given, in [-1, 1]: the value trimmed, lifted over its dead band, and turned round."""
        speed = clamp(self.alpha * self.value)
        if speed == 0:
            return 0.0
        duty = self._min_duty + (1 - self._min_duty) * abs(speed)
        return math.copysign(duty, -speed if self._inverted else speed)


class Robot:
    """A JetBot's two wheels. They stop when the interpreter exits, and when its process is killed.

    board: a row of ``boards.BOARDS``; i2c_bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; port: of ``jetbot_pro``.
    Left out, they come from JETBOT_BOARD, JETBOT_I2C_BUS and JETBOT_PORT, else are ``jetbot``, 1 and /dev/ttyACM0.
    left_motor_alpha, right_motor_alpha: trims, finite numbers, for a robot that does not drive straight.
    swap_motors, invert_left, invert_right: for a robot whose motors are connected otherwise.
    min_duty: the least part of full power, from 0 to below 1, that turns a wheel; speeds above 0 begin there.
    failsafe: seconds without a refresh after which a board that has a timer stops by itself; 0 for never.

    Speeds are in [-1, 1], 1 full forward, and clamped beyond. A speed that is no finite number stops both wheels and
    raises InvalidValue (a ValueError), as does an option that cannot be. A board that does not answer raises BusError
    (an OSError), and is set up again by the next call. Any thread and any signal handler may call.
    """

    _open = []  # every Robot that is not closed

    def __init__(self, board=None, i2c_bus=None, port=None, left_motor_alpha=1.0, right_motor_alpha=1.0,
                 swap_motors=False, invert_left=False, invert_right=False, min_duty=0.0, failsafe=0.0):
        board = (os.environ.get("JETBOT_BOARD") or "jetbot") if board is None else board
        i2c_bus = (os.environ.get("JETBOT_I2C_BUS") or 1) if i2c_bus is None else i2c_bus
        port = (os.environ.get("JETBOT_PORT") or PORT) if port is None else port
        options = Options(i2c_bus, port, finite(failsafe, "failsafe"))
        self.left_motor = Motor(self, left_motor_alpha, invert_left, min_duty)
        self.right_motor = Motor(self, right_motor_alpha, invert_right, min_duty)
        self._outputs = (self.right_motor, self.left_motor) if swap_motors else (self.left_motor, self.right_motor)
        self._speeds = dict.fromkeys(self._outputs, 0.0)
        self._lock = threading.RLock()  # a signal handler may come in between, in the same thread
        self._closed = False
        self.driver = open_board(board, options)
        self._take_over()
        self._guard = Guard(board, options)
        Robot._open.append(self)

    def set_motors(self, left_speed, right_speed):
        """Drive both wheels."""
        self._set_speeds({self.left_motor: left_speed, self.right_motor: right_speed})

    def forward(self, speed=1.0):
        """Drive straight on."""
        self.set_motors(speed, speed)

    def backward(self, speed=1.0):
        """Drive straight back."""
        self.set_motors(opposite(speed), opposite(speed))

    def left(self, speed=1.0):
        """Turn left on the spot."""
        self.set_motors(opposite(speed), speed)

    def right(self, speed=1.0):
        """Turn right on the spot."""
        self.set_motors(speed, opposite(speed))

    def stop(self):
        """Let both wheels stand."""
        self.set_motors(0, 0)

    def _set_speeds(self, speeds):
        """Drive the wheels in ``speeds``, a dict of Motor: speed; the others go on as they are."""
        with self._lock:
            try:
                speeds = {motor: clamp(finite(speed, "a speed")) for motor, speed in speeds.items()}
            except InvalidValue:
                self.stop()
                raise
            self._speeds.update(speeds)  # both at once: a signal handler may come at any moment
            self._act(self.driver.drive)

    def refresh(self, idle=True):
        """Check that the board still does what it was told, set it up again if not, and keep its timer running.

        To be called 20 times a second, where it is called at all. idle: whether no command went out just now.
        """
        with self._lock:
            self._act(self.driver.refresh, idle)

    def heartbeat(self):
        """Say that this program does not hang. Once said, it must be said again within a second, or the wheels stop."""
        if not self._guard.is_alive():  # somebody killed it
            with self._lock:
                if not self._closed:  # the guard of a closed robot would stop whoever drives the board now
                    self._guard.start()
        self._guard.heartbeat()

    def _act(self, action, *arguments):
        if self._closed:
            raise JetbotError("this robot is closed", "Make a new Robot().")
        done = None
        while done != (wanted := [motor.output for motor in self._outputs]):
            action(*wanted, *arguments)
            done = wanted  # unless a signal handler has set other speeds meanwhile

    def close(self):
        """Stop the wheels and let go of the board. May be called twice.

        Raises BusError when the board does not answer; the guard then goes on trying for some minutes.
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

    def _take_over(self):
        """Close an earlier Robot on the same board, as a notebook's cell leaves behind that is run again."""
        for predecessor in [other for other in Robot._open if other._place() == self._place()]:
            predecessor._close_quietly()

    def _place(self):
        return self.driver.link.name, self.driver.link.address

    def _close_quietly(self):
        with contextlib.suppress(BusError):  # the guard tells it
            self.close()

    def _forget(self):
        """In a forked child: the wheels are the parent's, and so is the end of the pipe to the guard."""
        self._lock = threading.RLock()  # another thread may have held the old one
        self._closed = True
        self._guard.leave()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def close_all():
    """At the interpreter's end: stop the wheels of every Robot."""
    for robot in list(Robot._open):
        robot._close_quietly()


def forget_all():
    """In a forked child: leave every Robot to the parent."""
    for robot in Robot._open:
        robot._forget()
    Robot._open.clear()


atexit.register(close_all)
os.register_at_fork(after_in_child=forget_all)


def opposite(speed):
    """The speed the other way; what has none is returned as it is, and refused later."""
    try:
        return -speed
    except TypeError:
        return speed


def finite(number, name):
    """The number as a float; InvalidValue for what is no finite number."""
    try:
        if math.isfinite(number):
            return float(number)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidValue(f"{name} must be a finite number, not {number!r}")
