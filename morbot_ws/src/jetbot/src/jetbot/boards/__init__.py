"""The motor boards of the JetBot. A board is a row of BOARDS."""

from typing import NamedTuple, Optional, Sequence, Type, Union

from ..errors import InvalidValue
from ..kinds import ADDRESS, address_of
from .driver import DEFAULT_PWM_FREQUENCY, MotorDriver, Telemetry
from .jetbot_pro import JetBotPro
from .pwm_motors import ADAFRUIT, WAVESHARE, WAVESHARE_HAT, HBridge, PwmMotors, Wiring
from .scmd import ScmdMotors

__all__ = ["BOARDS", "DEFAULT_PORT", "DEFAULT_PWM_FREQUENCY", "SERIAL_BOARD", "Board", "HBridge", "MotorDriver",
           "PwmMotors", "Telemetry", "Wiring", "find_board"]

SERIAL_BOARD = "jetbot_pro"  # the only one on a serial port
DEFAULT_PORT = "/dev/ttyACM0"  # of that


class Board(NamedTuple):
    """A row of BOARDS: with it alone, a board is driven, found by the doctor, calibrated, faked and simulated.

    address: its 7-bit I2C address, None for a board on a serial port; jumpers: those that can be set on it;
    wirings: of the driver PwmMotors.
    chip: the class in ``fake.chips`` that simulates its chip; left, right: how each motor is wired to that, as its
    ``speed`` takes it. These come from the circuit diagram, not from the driver, so that a driver's mistake shows.
    """

    driver: Type[MotorDriver]
    address: Optional[int] = None
    jumpers: Sequence[int] = ()
    wirings: Sequence[Wiring] = ()
    chip: str = ""
    left: object = None
    right: object = None


# Adafruit's and Waveshare's boards share an address and answer alike; `jetbot` drives both layouts at once, and is
# simulated with Adafruit's. Adafruit's jumpers A0 to A4 add to 0x60, those of Waveshare's Motor Driver HAT to 0x40
# (their user manuals); SparkFun's four jumpers select 0x58 to 0x63 (main.c of its firmware).
BOARDS = {
    "jetbot": Board(PwmMotors, 0x60, range(0x60, 0x78), (ADAFRUIT, WAVESHARE),
                    chip="PCA9685", left=(8, 9, 10), right=(13, 12, 11)),
    "adafruit": Board(PwmMotors, 0x60, range(0x60, 0x78), (ADAFRUIT,),
                      chip="PCA9685", left=(8, 9, 10), right=(13, 12, 11)),
    "waveshare": Board(PwmMotors, 0x60, range(0x60, 0x78), (WAVESHARE,),
                       chip="PCA9685", left=(None, 1, 0), right=(None, 2, 3)),
    "waveshare_hat": Board(PwmMotors, 0x40, range(0x40, 0x60), (WAVESHARE_HAT,),
                           chip="PCA9685", left=(0, 2, 1), right=(5, 4, 3)),
    "sparkfun": Board(ScmdMotors, 0x5D, range(0x58, 0x64), chip="SCMD", left=0x20, right=0x21),
    SERIAL_BOARD: Board(JetBotPro, chip="JetBotPro", left=-1, right=1),
}


def find_board(name: str, i2c_address: Union[int, str, None] = None) -> Board:
    """Return the row of BOARDS with this name, at this address instead of its own; raise InvalidValue for a bad one.

    i2c_address: 0x03 to 0x77, or its text, as "0x61"; a board on a serial port ignores it.
    """
    if name not in list(BOARDS):  # a list: what a YAML file gives may not be hashable
        raise InvalidValue(f"there is no board {name!r}", f"Choose one of: {', '.join(BOARDS)}.")
    row = BOARDS[name]
    if i2c_address is None:
        return row
    ADDRESS.check("the I2C address", i2c_address)
    return row._replace(address=row.address and address_of(i2c_address))
