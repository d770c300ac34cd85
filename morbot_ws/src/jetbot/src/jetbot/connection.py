"""From a board and where it is to its driver, ready to drive; and the lock by which one program drives it."""

import contextlib
import errno
import hashlib
import os
import socket
import time
from pathlib import Path
from typing import Callable, Optional, Union

from . import fake
from .boards import DEFAULT_PWM_FREQUENCY, Board, MotorDriver
from .errors import JetbotError, NoAnswer, NotReady
from .host import doctor_command, peer_of, program_name
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
    link = I2CDevice(place, board.address, board.chip) if board.address else SerialLink(place)
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


def lock_board(place: str, address: Optional[int]) -> socket.socket:
    """Return a lock on the board at this place, a ``locate``, and I2C address; it is held until it is closed.

    Raises JetbotError if another program holds it. The lock is the name of an abstract socket, unix(7): it reaches all
    users, and the containers that share this network namespace (``network_mode: host``).
    """
    name = f"\0jetbot {hashlib.sha256(identity(place).encode()).hexdigest()} {address}".encode()
    lock = socket.socket(socket.AF_UNIX)
    try:
        lock.bind(name)
        lock.listen()  # so that ``holder`` can connect
    except OSError as error:
        lock.close()
        if error.errno != errno.EADDRINUSE:
            raise
        board = f"0x{address:02x} on {place}" if address else place
        raise JetbotError(f"another program{holder(name)} already drives {board}", "End that first.") from None
    return lock


def identity(place: str) -> str:
    """Return what names the board's bus or port, whatever path leads to it."""
    path = Path(os.path.realpath(fake.folder_of(place) or place))
    return f"device {path.stat().st_rdev}" if path.is_char_device() else str(path)


def holder(name: bytes) -> str:
    """Return " (PROGRAM, process N)" for the process that holds the lock, "" if that cannot be seen."""
    with socket.socket(socket.AF_UNIX) as probe:
        probe.setblocking(False)
        try:
            probe.connect(name)
        except OSError:
            return ""
        pid, _ = peer_of(probe)
    program = program_name(pid)
    return f" ({program}, process {pid})" if program else ""
