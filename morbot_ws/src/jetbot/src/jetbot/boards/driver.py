"""The contract between a robot and its motor board."""

import abc
from typing import Any, Callable, NamedTuple, Sequence, Tuple

Link = Any  # an I2CDevice or a SerialLink; a fake bus behind one knows all boards, so no board may import them
DEFAULT_PWM_FREQUENCY = 1526  # Hz, the most that a PCA9685 can do; the JetBot library asks for 1600


class Telemetry(NamedTuple):
    """What a board measures of its own motion. Axes: forward, left, up. Position and yaw count from the board's start.

    x, y: mm and yaw: mrad, as the board counts them: signed 16-bit integers, which wrap.
    """

    gyro: Tuple[float, float, float]          # rad/s
    acceleration: Tuple[float, float, float]  # m/s^2
    x: int
    y: int
    yaw: int


class MotorDriver(abc.ABC):
    """Turns two wheel speeds into what one motor board understands.

    A driver holds no clock and no thread but that of ``listen``; its caller decides when. Every method but ``close``
    may raise BusError; after one, the next ``drive`` sets the board up again.
    pwm_frequency: in Hz; a board whose frequency is fixed ignores it. wirings: see PwmMotors.
    """

    chip_name = ""  # as the doctor calls the chip on an I2C bus
    stretches_clock = False  # True: the chip holds the bus's clock back, which some computers mishandle

    limit = 1.0  # largest |wheel speed| that the board accepts; Robot clamps a speed to it, and nothing else does
    resolution = 0.0  # the board's step of a wheel speed: half a step or less is rounded to 0
    closed_loop = False  # True: the board controls its wheel speeds itself; they are in m/s, for wheels 2 m apart
    ignores: Sequence[str] = ()  # the controller's parameters that change nothing on this board
    resets = 0       # how often the board was found at its power-on values: a brown-out
    overwritten = 0  # how often it held what another program has written
    keep_alive_interval = 0.25  # s: how often ``keep_alive`` is due while the wheels turn

    def __init__(self, link: Link, pwm_frequency: float = DEFAULT_PWM_FREQUENCY,
                 wirings: Sequence[Any] = ()):
        self.link = link

    @property
    def in_sync(self) -> bool:
        """Whether the board holds what it was sent, as far as is known; else the next ``drive`` restores it."""
        return True

    @staticmethod
    def recognizes(link: Link) -> bool:
        """Return whether the chip that answers there is one for this driver. It is only read. Raise BusError."""
        return False

    @abc.abstractmethod
    def start(self) -> None:
        """Set the board up with both motors off, whatever state it is in; raise NotReady while it is starting."""

    def stop(self) -> None:
        """Switch both motors off, whatever state the board is in; its settings stay. Raise NotReady as ``start``."""
        self.start()

    @abc.abstractmethod
    def drive(self, left: float, right: float) -> None:
        """Turn the wheels at these speeds, in [-limit, limit], positive forward. A repeated speed costs no transfer."""

    def verify(self) -> None:
        """Read back a part of what the board holds, in one transfer at most; the next ``drive`` restores what it lost.

        Successive calls go through all parts.
        """

    def invalidate(self) -> None:
        """Something else has driven the board, such as the guard: the next ``drive`` sets it up again."""

    def keep_alive(self) -> None:
        """Feed the board's own timer, which stops the motors when it is no longer fed. Without a timer: nothing."""

    def listen(self, callback: Callable[[Telemetry], None]) -> None:
        """Call back with each Telemetry, from a thread of its own. A board that measures nothing never calls back."""

    def close(self) -> None:
        """Release the board; its motors keep their speeds."""
        self.link.close()
