"""The motor boards of the JetBot: how two wheel speeds become outputs. A board is a row of BOARDS."""

from typing import NamedTuple, Optional, Tuple

from .errors import InvalidValue
from .i2c import I2CDevice
from .pca9685 import FULL_DUTY, PCA9685


class HBridge(NamedTuple):
    """Which PCA9685 outputs turn one wheel.

    forward, backward: the output that is high while the wheel turns that way.
    pwm: the output that carries the duty; None where the direction's own output carries it.
    """

    forward: int
    backward: int
    pwm: Optional[int] = None

    def duties(self, speed):
        """Output: duty for a speed in [-1, 1]; never both directions, and all low at rest."""
        duty = round(abs(speed) * FULL_DUTY)
        active, idle = (self.forward, self.backward) if speed > 0 else (self.backward, self.forward)
        if self.pwm is None:
            return {active: duty, idle: 0}
        return {self.pwm: duty, active: FULL_DUTY if duty else 0, idle: 0}


class Wiring(NamedTuple):
    """The two wheels of a board."""

    left: HBridge
    right: HBridge


# Adafruit's FeatherWing 2927 and Motor HAT with a TB6612: motors M1 and M2. The robot moves forward when they
# run what Adafruit's library calls backward, IN2 high.
ADAFRUIT = Wiring(left=HBridge(forward=9, backward=10, pwm=8), right=HBridge(forward=12, backward=11, pwm=13))

# Waveshare's JetBot board: the duty is on the direction outputs.
WAVESHARE = Wiring(left=HBridge(forward=1, backward=0), right=HBridge(forward=2, backward=3))


class PwmMotors:
    """Motors on a PCA9685, wired in one way or, where a scan cannot tell which, in several at once.

    left, right: speeds in [-1, 1], 1 full forward. Every method but ``close`` raises BusError.
    """

    def __init__(self, device, wirings):
        self.device = device
        self._wirings = wirings
        self._chip = PCA9685(device, [outputs(wiring) for wiring in wirings])

    def start(self):
        """Set the board up with both wheels off."""
        self._chip.start()

    def drive(self, left, right):
        """Turn the wheels at these speeds; after a BusError, the next call sets the board up anew."""
        duties = {}
        for wiring in self._wirings:
            duties.update(wiring.left.duties(left))
            duties.update(wiring.right.duties(right))
        self._chip.set_outputs(duties)

    def refresh(self, left, right):
        """Drive as before, and set a board up again that lost its power meanwhile."""
        self._chip.verify()
        self.drive(left, right)

    def close(self):
        """Let go of the bus; the wheels go on as they are."""
        self.device.close()


def outputs(wiring):
    """The range of PCA9685 outputs that a wiring uses."""
    used = [output for bridge in wiring for output in bridge.duties(1)]
    return range(min(used), max(used) + 1)


class Board(NamedTuple):
    """A row of the table: the chip's I2C address and how the wheels hang on it."""

    address: int
    wirings: Tuple[Wiring, ...]


# Adafruit's and Waveshare's boards share an address and answer alike; `jetbot` drives both layouts.
BOARDS = {
    "jetbot": Board(0x60, (ADAFRUIT, WAVESHARE)),
    "adafruit": Board(0x60, (ADAFRUIT,)),
    "waveshare": Board(0x60, (WAVESHARE,)),
}


def open_board(name, i2c_bus):
    """The motor board with this name, started: whatever turned before now stands. Raises InvalidValue, BusError."""
    if name not in BOARDS:
        raise InvalidValue(f"there is no board {name!r}", f"Choose one of: {', '.join(BOARDS)}.")
    row = BOARDS[name]
    board = PwmMotors(I2CDevice(i2c_bus, row.address), row.wirings)
    board.start()
    return board
