"""The motor boards of the JetBot. A board is a row of BOARDS."""

import contextlib
from functools import partial
from typing import Callable, NamedTuple, Optional, Union

from ..errors import InvalidValue, JetbotError, NoAnswer, NotReady
from ..host import doctor_command
from ..i2c import I2CDevice, bus_name
from ..kinds import ADDRESS, address_of
from ..serial_link import SerialLink
from ..wait import wait_until
from .driver import DEFAULT_PWM_FREQUENCY, MotorDriver, Telemetry
from .jetbot_pro import JetBotPro
from .pwm_motors import ADAFRUIT, WAVESHARE, WAVESHARE_HAT, HBridge, PwmMotors, Wiring
from .scmd import ScmdMotors

__all__ = ["BOARDS", "DEFAULT_PORT", "DEFAULT_PWM_FREQUENCY", "Board", "HBridge", "MotorDriver", "PwmMotors",
           "Telemetry", "Wiring", "find_board"]

DEFAULT_PORT = "/dev/ttyACM0"  # of a JetBot Pro
READY_TIMEOUT = 2.0            # s that a board may take from power-on until it can be set up
SET_UP_TRIES = 3               # of a board that loses its supply meanwhile
TRANSFER_TIME_LIMIT = 0.15     # s, of a board that has been started; a transfer takes milliseconds


class Board(NamedTuple):
    """A row of BOARDS: the driver, and the board's 7-bit I2C address, None for a board on a serial port."""

    driver: Callable[..., MotorDriver]  # (link, pwm_frequency)
    address: Optional[int] = None

    def place(self, i2c_bus: Union[int, str], port: str) -> str:
        """Return where the board is: the name of a bus, or a serial port. Raise InvalidValue for a bad bus."""
        return bus_name(i2c_bus) if self.address else port

    def open(self, place: str, pwm_frequency: float = DEFAULT_PWM_FREQUENCY) -> MotorDriver:
        """Return the driver of the board at this ``place``, started: both motors are off. Raise JetbotError."""
        driver = self._connect(place, pwm_frequency)
        try:
            set_up(driver)
        except JetbotError:
            driver.close()
            raise
        driver.link.time_limit = TRANSFER_TIME_LIMIT  # only now: what stops the wheels may take its time
        return driver

    def stop(self, place: str) -> None:
        """Switch both motors of the board at this ``place`` off; its settings stay. Raise JetbotError."""
        with contextlib.closing(self._connect(place)) as driver:
            when_ready(driver.stop)

    def _connect(self, place, *settings):
        return self.driver(I2CDevice(place, self.address) if self.address else SerialLink(place), *settings)


# Adafruit's and Waveshare's boards share an address and answer alike; `jetbot` drives both layouts at once.
BOARDS = {
    "jetbot": Board(partial(PwmMotors, wirings=(ADAFRUIT, WAVESHARE)), 0x60),
    "adafruit": Board(partial(PwmMotors, wirings=(ADAFRUIT,)), 0x60),
    "waveshare": Board(partial(PwmMotors, wirings=(WAVESHARE,)), 0x60),
    "waveshare_hat": Board(partial(PwmMotors, wirings=(WAVESHARE_HAT,)), 0x40),
    "sparkfun": Board(ScmdMotors, 0x5D),
    "jetbot_pro": Board(JetBotPro),
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


def set_up(driver: MotorDriver) -> None:
    """Start the board and read a part of it back: it may be another chip, which keeps what it likes.

    Raise JetbotError. A board that lost its supply meanwhile is set up again.
    """
    for _ in range(SET_UP_TRIES):
        when_ready(driver.start)
        driver.verify()
        if driver.in_sync:
            return
    raise NoAnswer(f"the chip at 0x{driver.link.address:02x} on {driver.link.name} is not the motor board: it does not "
                   "hold what it is sent", f"To find the board, run: {doctor_command()}")


def when_ready(action: Callable[[], None]) -> None:
    """Run the action of a driver as soon as its board is ready; raise NotReady if that takes too long."""
    if not wait_until(partial(succeeds, action), READY_TIMEOUT):
        action()


def succeeds(action: Callable[[], None]) -> bool:
    """Run the action and return True; return False if the board is not ready yet."""
    try:
        action()
    except NotReady:
        return False
    return True
