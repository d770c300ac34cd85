"""An I2C bus without hardware: a folder is the bus, a file in it is a chip, a byte of the file is a register.

Chips stay powered when the process that uses them ends. By hand:

    xxd FOLDER/0x60                        show the registers
    rm FOLDER/0x60                         unplug the chip
    echo 5 > FOLDER/0x60.fail              let its next 5 transfers fail
    echo 100000 > FOLDER/clock             take as long as a bus of 100 kHz (read when the bus is opened)
    printf '\\x56\\xB8' | dd of=FOLDER/0x41 bs=1 seek=4 conv=notrunc
                                           set the voltage of the supply to 11.1 V, which is 0x56B8 >> 3 times 4 mV
    python3 -m jetbot.fake FOLDER          power every chip on again: after unplugging, or as a brown-out
                  --i2c-address 0x61       plug a PCA9685 in at this address, too
                  --chip SCMD              another chip there
"""

import errno
import fcntl
import os
import re
import secrets
import shutil
import time
from pathlib import Path
from typing import Any, Callable, Dict, List, Optional, Sequence, Tuple, Type

from ..boards import BOARDS
from ..errors import BusError, NoAnswer
from . import Folder, chip_file, power_on_command
from .chip_files import chip_at, chip_in, label, read_chip, read_open
from .chips import INA219, Chip, chip_class

HALF_MADE = r"0x41$|0x..\.\d+$"
CLOCK_RANGE = (10.0, 1e7)  # Hz


def power_on(folder: Folder, address: Optional[int] = None, chip: str = "") -> None:
    """Give every chip its power-on registers; make the folder, and plug in the chips that are missing.

    address: of one more chip, a motor board's; nothing is plugged in where that cannot be. chip: its class, by default
    that of the board with this address, or a PCA9685. A new folder is there with all its chips or not at all: the disk
    may be full, and whoever makes it may be killed.
    """
    folder = Path(folder)
    chips = chips_of(folder, address, chip_class(chip) if chip else chip_at(address))
    new = (folder if folder.exists() else folder.parent) / f".{folder.name}.{secrets.token_hex(4)}"
    new.mkdir(parents=True)
    try:
        for each, kind in chips.items():
            chip_file(new, each).write_bytes(kind.POWER_ON + label(kind))
        if new.parent == folder:
            for file in new.iterdir():
                file.replace(folder / file.name)  # at once, for the processes that use the chip
        else:
            new.rename(folder)
    except OSError as error:
        if error.errno not in (errno.ENOTEMPTY, errno.EEXIST):  # else another process has made the folder meanwhile
            raise
    finally:
        shutil.rmtree(new, ignore_errors=True)


def chips_of(folder: Path, address: Optional[int], chip: Type[Chip]) -> Dict[Optional[int], Type[Chip]]:
    """Return {address: chip}: those of all boards, what is plugged in, this one, and a voltmeter where none of them is.

    Of two boards with one address, the first has its chip there, unless the other one's is plugged in.
    """
    boards = {address: chip_at(address) for address in [board.address for board in BOARDS.values()]}
    for file in folder.glob("0x[0-7][0-9a-f]"):
        plugged = int(file.name, 16)
        kind, _ = chip_in(file.read_bytes(), plugged)
        if kind is not INA219:
            boards[plugged] = kind
    if address in chip.ADDRESSES:
        boards[address] = chip
    free = [each for each in INA219.ADDRESSES if each not in boards]
    return {**boards, **dict.fromkeys(free[:1], INA219)}


class FakeBus:
    """Takes the place of ``smbus2.SMBus``: the methods that the drivers use, and the OSErrors of the kernel.

    folder: made, with every known chip in it, if it does not exist or holds only the buses of namespaces.
    address, chip: of one more chip in a folder that is made, as for ``power_on``. Raise NoAnswer if another one than
    this ``chip`` is there.
    """

    def __init__(self, folder: Folder, address: Optional[int] = None, chip: str = ""):
        self._folder = Path(folder)
        if is_new(self._folder):
            power_on(self._folder, address, chip)
        if address and chip:
            require(self._folder, address, chip)
        self._seconds_per_bit = seconds_per_bit(self._folder / "clock")

    def read_byte_data(self, address: int, register: int) -> int:
        return self.read_i2c_block_data(address, register, 1)[0]

    def read_i2c_block_data(self, address: int, register: int, length: int) -> List[int]:
        return self._transfer(address, 3 + length,
                              lambda chip, registers: chip.read(registers, register, length))

    def write_byte_data(self, address: int, register: int, value: int) -> None:
        self.write_i2c_block_data(address, register, [value])

    def write_i2c_block_data(self, address: int, register: int, data: Sequence[int]) -> None:
        if len(data) > 32:
            raise ValueError("an SMBus block holds 32 bytes at most")
        self._transfer(address, 2 + len(data), lambda chip, registers: chip.write(registers, register, data))

    def close(self) -> None:
        """Nothing stays open between transfers."""

    def _transfer(self, address: int, wire_bytes: int, action: Callable[[Type[Chip], bytearray], Any]) -> Any:
        """Act on the chip's registers at once at the STOP, when the wire has carried all bytes."""
        file = f"{self._folder}/0x{address:02x}"  # pathlib would take longer than all the rest
        fail_if_asked(f"{file}.fail")
        end = time.perf_counter() + (2 + 9 * wire_bytes) * self._seconds_per_bit
        try:
            descriptor = os.open(file, os.O_RDWR)
        except FileNotFoundError:
            raise no_answer() from None
        try:
            if self._seconds_per_bit:
                time.sleep(max(0.0, end - time.perf_counter()))
            return act(descriptor, file, address, action)
        finally:
            os.close(descriptor)


def act(descriptor: int, file: str, address: int, action: Callable[[Type[Chip], bytearray], Any]) -> Any:
    """Act on the registers in a chip's open file, and return the result; other processes wait meanwhile.

    Only the bytes that have changed are written: whoever writes others at this moment, by hand too, loses none.
    """
    fcntl.lockf(descriptor, fcntl.LOCK_EX)  # of this process, so that a signal handler may come in between
    if not os.fstat(descriptor).st_nlink:  # unplugged, or a brown-out, before the STOP
        raise no_answer()
    chip, before = read_open(descriptor, file, address)
    registers = bytearray(before)
    result = action(chip, registers)
    if result is None:  # a write; the file's time is then that of the last write
        first, end = span_of_changes(before, registers)
        os.pwrite(descriptor, registers[first:end], first)
    return result


def span_of_changes(before: bytes, after: bytearray) -> Tuple[int, int]:
    """Return from where to where two sequences of one length differ; (0, 1) if they do not."""
    changed = int.from_bytes(before, "little") ^ int.from_bytes(after, "little")  # faster than byte by byte
    lowest = changed & -changed
    return max(0, lowest.bit_length() - 1) // 8, max(1, (changed.bit_length() + 7) // 8)


def is_new(folder: Path) -> bool:
    """Return whether nothing was ever plugged in there: it does not exist, or holds only the buses of namespaces.

    So does one that an earlier version has left half made: with no chip but the first, and what it was writing.
    """
    if not folder.exists():
        return True
    entries = list(folder.iterdir())
    return bool(entries) and all(entry.is_dir() or re.match(HALF_MADE, entry.name) for entry in entries)


def seconds_per_bit(clock: Path) -> float:
    """Return the time that a bit takes by the file ``clock``, which holds the clock in Hz; 0 without such a file."""
    if not clock.exists():
        return 0.0
    try:
        frequency = float(clock.read_text())
    except ValueError:
        frequency = 0.0
    if not CLOCK_RANGE[0] <= frequency <= CLOCK_RANGE[1]:
        raise BusError(f"{clock} must hold the clock of the bus in Hz, 10 to 10000000",
                       "Write such a number into it, or delete it.", errno.EINVAL)
    return 1 / frequency


def require(folder: Folder, address: int, chip: str) -> None:
    """Raise NoAnswer if another chip than this one is plugged in there; none at all answers for itself."""
    file = chip_file(folder, address)
    found = read_chip(str(file), address)[0].__name__ if file.exists() else chip
    if found != chip:
        raise NoAnswer(f"the chip at {file.name} on fake:{folder} is simulated as {found}, not as {chip}",
                       f"To plug that in: {power_on_command(folder, address, chip)}")


def plug_in_advice(folder: Folder, address: int, chip: str = "") -> str:
    """Return how to plug a motor board's chip in at an address where there is none. chip: as for ``power_on``."""
    kind = chip_class(chip) if chip else chip_at(address)
    if address not in kind.ADDRESSES:
        return f"A fake motor board is at 0x{min(kind.ADDRESSES):02x} to 0x{max(kind.ADDRESSES):02x}."
    own = address in [board.address for board in BOARDS.values()] and kind is chip_at(address)
    return f"To plug it in: {power_on_command(folder, None if own else address, kind.__name__)}"


def fail_if_asked(request: str) -> None:
    """Fail as long as the file ``request`` holds a number above 0."""
    if not os.path.exists(request):
        return
    text = Path(request).read_text().strip()
    if not text.isdecimal():  # it is being written
        return
    if int(text) == 0:
        os.unlink(request)
        return
    Path(request).write_text(str(int(text) - 1))
    raise no_answer()


def no_answer() -> OSError:
    """Return what the kernel raises when nobody acknowledges the address."""
    return OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
