"""The motor boards of the JetBot. A board is a row of BOARDS.

A driver, what drives a board, has four methods, of which all but ``close`` may raise BusError:

    start()                     set the board up with both wheels off
    drive(left, right)          turn the wheels at these speeds, in [-1, 1]; after a BusError, start anew first
    refresh(left, right, idle)  drive as before, and keep board and computer of one mind; to be called 20 times a
                                second; idle: whether no command went out just now
    close()                     let go of the board; the wheels go on as they are

and ``link``: the I2CDevice or SerialLink to the board, with ``name``, ``transfers`` (tried) and ``errors`` (of them).
The driver of a board that measures how it moves also has

    listen(callback)            call back with each jetbot_pro.Telemetry, from a thread of its own
"""

from functools import partial
from typing import Callable, NamedTuple, Optional

from ..errors import InvalidValue, JetbotError
from ..i2c import I2CDevice
from ..serial_link import SerialLink
from .jetbot_pro import JetBotPro
from .pwm_motors import ADAFRUIT, WAVESHARE, PwmMotors
from .scmd import ScmdMotors

PORT = "/dev/ttyACM0"  # where a JetBot Pro is, unless told otherwise


class Options(NamedTuple):
    """How to reach a board, and what it should do when the computer hangs.

    i2c_bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; port: a serial device or pyserial URL;
    failsafe: seconds without a word from the computer after which the board stops by itself, if it can; 0 for never.
    """

    i2c_bus: object = 1
    port: str = PORT
    failsafe: float = 0.0


class Board(NamedTuple):
    """A row of the table: the class of its driver, and its I2C address, None for the serial port."""

    driver: Callable
    address: Optional[int] = None


# Adafruit's and Waveshare's boards share an address and answer alike; `jetbot` drives both layouts.
BOARDS = {
    "jetbot": Board(partial(PwmMotors, wirings=(ADAFRUIT, WAVESHARE)), 0x60),
    "adafruit": Board(partial(PwmMotors, wirings=(ADAFRUIT,)), 0x60),
    "waveshare": Board(partial(PwmMotors, wirings=(WAVESHARE,)), 0x60),
    "sparkfun": Board(ScmdMotors, 0x5D),
    "jetbot_pro": Board(JetBotPro),
}


def find_board(name):
    """The row of BOARDS with this name; InvalidValue where there is none."""
    if name not in list(BOARDS):  # a list: what a YAML file gives may not be hashable
        raise InvalidValue(f"there is no board {name!r}", f"Choose one of: {', '.join(BOARDS)}.")
    return BOARDS[name]


def open_board(name, options):
    """The driver of the board with this name, started: whatever turned before now stands.

    Raises InvalidValue for a name or an option that cannot be, BusError for a board that does not answer.
    """
    row = find_board(name)
    link = I2CDevice(options.i2c_bus, row.address) if row.address else SerialLink(options.port)
    driver = row.driver(link, options)
    try:
        driver.start()
    except JetbotError:
        link.close()
        raise
    return driver
