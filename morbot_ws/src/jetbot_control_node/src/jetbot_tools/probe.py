"""Checks of what a motor board may be connected to. They only read."""

import contextlib
import os
import threading
from pathlib import Path
from typing import List, NamedTuple, Union

from jetbot.boards import BOARDS, find_board, scmd
from jetbot.boards.jetbot_pro import JetBotPro
from jetbot.errors import JetbotError
from jetbot.host import program_name
from jetbot.i2c import I2CDevice
from jetbot.serial_link import SerialLink
from jetbot.text import printable

from .commands import launch

TELEMETRY_TIMEOUT = 1.0  # s; a JetBot Pro sends many frames in that time


class Check(NamedTuple):
    """The result of one check: whether it is as it should be, what was found, and what to do about it."""

    name: str
    ok: bool
    finding: str
    advice: str = ""
    command: str = ""  # starts the robot that the check has found

    def __str__(self) -> str:
        return printable(f"{'ok' if self.ok else 'NOT':<4}{self.name}: {self.finding}. {self.advice}".rstrip())


def check_users(device: str) -> List[Check]:
    """Check that no other program has a device open, as far as this user may see; [] if there is no such device."""
    if not os.path.exists(device):
        return []
    target, users = os.path.realpath(device), []
    for process in Path("/proc").glob("[0-9]*"):
        with contextlib.suppress(OSError):  # another user's, or ended meanwhile
            if int(process.name) != os.getpid() and target in map(os.readlink, (process / "fd").iterdir()):
                users.append(f"{program_name(int(process.name))} ({process.name})")
    if users:
        return [Check(device, False, f"also open in {', '.join(users)}",
                      "Two programs on one motor board disturb each other: end one of them.")]
    whose = "" if os.geteuid() == 0 else " of this user"
    return [Check(device, True, f"no other program{whose} has it open")]


def check_board(board: str, i2c_bus: Union[int, str], port: str) -> Check:
    """Check that a board answers on its bus or port; raise InvalidValue for an unknown board or a bad bus."""
    row = find_board(board)
    place = row.place(i2c_bus, port)
    return check_chip(place, row.address) if row.address else check_serial(place)


def check_chip(bus: Union[int, str], address: int) -> Check:
    """Check that a motor board answers a read, as all boards at one address do. bus: as for an I2CDevice."""
    with contextlib.closing(I2CDevice(bus, address)) as chip:
        name = f"0x{address:02x} on {chip.name}"
        try:
            answer = chip.read(scmd.ID)
        except JetbotError as error:
            return Check(name, False, error.reason, error.advice)
    if address == BOARDS["sparkfun"].address and answer != scmd.ID_WORD:
        return Check(name, False, "the chip that answers is not a SparkFun motor driver")
    boards = [board for board, row in BOARDS.items() if row.address == address]
    finding = f"answers, and can be a board {' or '.join(boards)}"
    return Check(name, True, finding, command=launch(board=boards[0], i2c_bus=bus))


def check_serial(port: str) -> Check:
    """Check that a JetBot Pro sends telemetry on the serial port."""
    arrived = threading.Event()
    try:
        with contextlib.closing(JetBotPro(SerialLink(port))) as driver:
            driver.link.read()  # raises what ``listen`` would not
            driver.listen(lambda telemetry: arrived.set())
            arrived.wait(TELEMETRY_TIMEOUT)
    except JetbotError as error:
        return Check(port, False, error.reason, error.advice)
    if arrived.is_set():
        return Check(port, True, "a JetBot Pro reports", command=launch(board="jetbot_pro", port=port))
    return Check(port, False, "opens, but no JetBot Pro reports", "Is it this port, and is the robot switched on?")
