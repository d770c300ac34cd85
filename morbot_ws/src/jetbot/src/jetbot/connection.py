"""From a board and where it is to its driver, ready to drive."""

import contextlib
import time
from typing import Callable, Union

from .boards import DEFAULT_PWM_FREQUENCY, Board, MotorDriver
from .errors import JetbotError, NoAnswer, NotReady
from .host import doctor_command
from .i2c import I2CDevice, bus_name
from .serial_link import SerialLink

READY_TIMEOUT = 2.0          # s that a board may take from power-on until it can be set up
READY_INTERVAL = 0.01        # s
SET_UP_TRIES = 3             # of a board that loses its supply meanwhile
TRANSFER_TIME_LIMIT = 0.15   # s, of a board that has been started; a transfer takes milliseconds


def locate(board: Board, i2c_bus: Union[int, str], port: str) -> str:
    """Return where a board is: the name of a bus, or a serial port. Raise InvalidValue for a bad bus."""
    return bus_name(i2c_bus) if board.address else port


def connect(board: Board, place: str, pwm_frequency: float = DEFAULT_PWM_FREQUENCY) -> MotorDriver:
    """Return the driver of the board at this place, a ``locate``; nothing is sent."""
    link = I2CDevice(place, board.address) if board.address else SerialLink(place)
    return board.driver(link, pwm_frequency, board.wirings)


def open_board(board: Board, place: str, pwm_frequency: float = DEFAULT_PWM_FREQUENCY) -> MotorDriver:
    """Return the driver of the board at this place, started: both motors are off. Raise JetbotError."""
    driver = connect(board, place, pwm_frequency)
    try:
        set_up(driver)
    except JetbotError:
        driver.close()
        raise
    driver.link.time_limit = TRANSFER_TIME_LIMIT  # only now: what stops the wheels may take its time
    return driver


def stop_board(board: Board, place: str) -> None:
    """Switch both motors of the board at this place off; its settings stay. Raise JetbotError."""
    with contextlib.closing(connect(board, place)) as driver:
        when_ready(driver.stop)


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
    deadline = time.monotonic() + READY_TIMEOUT
    while True:
        try:
            return action()
        except NotReady:
            if time.monotonic() > deadline:
                raise
        time.sleep(READY_INTERVAL)
