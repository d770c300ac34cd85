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
    """One wheel of a Robot."""

    def __init__(self, robot, alpha, inverted, min_duty):
        self._robot = robot
        self._value = 0.0
        self._inverted = inverted
        self._min_duty = finite(min_duty, "min_duty")
        self.alpha = alpha
        if not 0 <= self._min_duty < 1:
            raise InvalidValue(f"min_duty must be at least 0 and below 1, not {min_duty!r}")

    @property
    def value(self):
        """The speed last set, in [-1, 1], 1 full forward. Setting it drives the wheel, clamped to that range."""
        return self._value

    @value.setter
    def value(self, speed):
        self._robot.set_speeds({self: speed})

    @property
    def alpha(self):
        """A trim that the speed is multiplied with from the next command on; a finite number."""
        return self._alpha

    @alpha.setter
    def alpha(self, alpha):
        self._alpha = finite(alpha, "an alpha")

    @property
    def output(self):
        """What the motor is given: the value trimmed, lifted over the motor's dead band, and turned round."""
        speed = clamp(self.alpha * self._value)
        if speed == 0:
            return 0.0
        duty = self._min_duty + (1 - self._min_duty) * abs(speed)
        return math.copysign(duty, -speed if self._inverted else speed)


class Robot:
    """A JetBot's two wheels. They stop when the interpreter exits, and when its process is killed.

    board: a row of ``boards.BOARDS``; i2c_bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; port: of ``jetbot_pro``.
    Left out, they come from JETBOT_BOARD, JETBOT_I2C_BUS and JETBOT_PORT, else are ``jetbot``, 1 and /dev/ttyACM0.
    left_motor_alpha, right_motor_alpha: trims for a robot that does not drive straight.
    swap_motors, invert_left, invert_right: for a robot whose motors are connected otherwise.
    min_duty: the least part of full power, 0 to 1, that turns a wheel; speeds above 0 begin there.
    failsafe: seconds without a refresh after which a board that has a timer stops by itself; 0 for never.

    Speeds are in [-1, 1], 1 full forward, and clamped beyond. A speed that is no finite number stops both wheels and
    raises InvalidValue (a ValueError). A board that does not answer raises BusError (an OSError), and is set up again
    by the next call. Any thread and any signal handler may call.
    """

    _drivers = {}  # by link: the Robot that drives what hangs on it

    def __init__(self, board=None, i2c_bus=None, port=None, left_motor_alpha=1.0, right_motor_alpha=1.0,
                 swap_motors=False, invert_left=False, invert_right=False, min_duty=0.0, failsafe=0.0):
        board = os.environ.get("JETBOT_BOARD", "jetbot") if board is None else board
        i2c_bus = os.environ.get("JETBOT_I2C_BUS", 1) if i2c_bus is None else i2c_bus
        port = os.environ.get("JETBOT_PORT", PORT) if port is None else port
        options = Options(i2c_bus, port, finite(failsafe, "failsafe"))
        self.left_motor = Motor(self, left_motor_alpha, invert_left, min_duty)
        self.right_motor = Motor(self, right_motor_alpha, invert_right, min_duty)
        self._outputs = (self.right_motor, self.left_motor) if swap_motors else (self.left_motor, self.right_motor)
        self._lock = threading.RLock()  # a signal handler may come in between, in the same thread
        self._closed = False
        self.board = open_board(board, options)
        self._take_over()
        self._guard = Guard(board, options)
        atexit.register(self._close_at_exit)
        os.register_at_fork(after_in_child=self._forget)

    def set_motors(self, left_speed, right_speed):
        """Drive both wheels."""
        self.set_speeds({self.left_motor: left_speed, self.right_motor: right_speed})

    def forward(self, speed=1.0):
        """Drive straight on."""
        self.set_motors(speed, speed)

    def backward(self, speed=1.0):
        """Drive straight back."""
        self.set_motors(-speed, -speed)

    def left(self, speed=1.0):
        """Turn left on the spot."""
        self.set_motors(-speed, speed)

    def right(self, speed=1.0):
        """Turn right on the spot."""
        self.set_motors(speed, -speed)

    def stop(self):
        """Let both wheels stand."""
        self.set_motors(0, 0)

    def set_speeds(self, speeds):
        """Drive the wheels in ``speeds``, a dict of Motor: speed; the others go on as they are."""
        with self._lock:
            try:
                speeds = {motor: clamp(finite(speed, "a speed")) for motor, speed in speeds.items()}
            except InvalidValue:
                speeds = {self.left_motor: 0.0, self.right_motor: 0.0}
                raise
            finally:
                for motor, speed in speeds.items():
                    motor._value = speed
                self._act(self.board.drive)

    def refresh(self, idle=True):
        """Check that the board still does what it was told, set it up again if not, and keep its timer running.

        To be called 20 times a second, where it is called at all. idle: whether no command went out just now.
        """
        with self._lock:
            self._act(self.board.refresh, idle)

    def heartbeat(self):
        """Say that this program does not hang. Once said, it must be said again within a second, or the wheels stop."""
        self._guard.heartbeat()

    def _act(self, action, *arguments):
        if self._closed:
            raise JetbotError("this robot is closed", "Make a new Robot().")
        done = None
        while done != self._wanted():  # a signal handler may have set other speeds meanwhile
            done = self._wanted()
            action(*done, *arguments)

    def _wanted(self):
        return [motor.output for motor in self._outputs]

    def close(self):
        """Stop the wheels and let go of the board. May be called twice.

        Raises BusError when the board does not answer; the guard then goes on trying for some minutes.
        """
        with self._lock:
            if self._closed:
                return
            self._closed = True
            try:
                self.board.drive(0, 0)
                self._guard.dismiss()
            finally:
                self._guard.leave()
                self.board.close()
                atexit.unregister(self._close_at_exit)

    def _take_over(self):
        """Close an earlier Robot on the same board, as a notebook's cell leaves behind that is run again."""
        link = self.board.device.name, self.board.device.address
        predecessor, Robot._drivers[link] = Robot._drivers.get(link), self
        if predecessor:
            predecessor._close_at_exit()

    def _close_at_exit(self):
        with contextlib.suppress(BusError):  # the guard tells it
            self.close()

    def _forget(self):
        """In a forked child: the wheels are the parent's, and so is the end of the pipe to the guard."""
        self._closed = True
        self._guard.leave()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def finite(number, name):
    """The number as a float; InvalidValue for what is no finite number."""
    try:
        if math.isfinite(number):
            return float(number)
    except (TypeError, ValueError, OverflowError):
        pass
    raise InvalidValue(f"{name} must be a finite number, not {number!r}")
