"""An I2C bus without hardware: a folder is the bus, a file in it is a chip, a byte of the file is a register.

Chips stay powered when the process that uses them ends. By hand:

    xxd FOLDER/0x60                        show the registers
    rm FOLDER/0x60                         unplug the chip
    echo 5 > FOLDER/0x60.fail              let its next 5 transfers fail
    echo 3 > FOLDER/0x60.cut               end its next write with a STOP after 3 bytes of data, not acknowledged
    echo 100000 > FOLDER/clock             take as long as a bus of 100 kHz (read when the bus is opened)
    printf '\\x56\\xB8' | dd of=FOLDER/0x41 bs=1 seek=4 conv=notrunc
                                           set the voltage of the supply to 11.1 V, which is 0x56B8 >> 3 times 4 mV
    python3 -m jetbot.fake FOLDER          power every chip on again: after unplugging, or as a brown-out
                  --i2c-address 0x61       plug a PCA9685 in at this address, too
"""

import errno
import os
import time
from pathlib import Path
from typing import List, Optional, Sequence, Union

from ..boards import BOARDS
from ..errors import BusError
from . import Folder, chip_file, power_on_command
from .chip_files import check_chip, open_file, read_text
from .chips import INA219, PCA9685, chip_class

SENSORS = {0x41: INA219}  # beside a robot's chip
CLOCK_RANGE = (10.0, 1e7)  # Hz


def power_on(folder: Folder, address: Optional[int] = None) -> None:
    """Give every chip its power-on registers; make the folder, and plug in the chips that are missing.

    address: of one more chip, a motor board's; nothing is plugged in where a PCA9685 cannot be.
    """
    Path(folder).mkdir(parents=True, exist_ok=True)
    plugged = {int(file.name, 16) for file in Path(folder).glob("0x[0-7][0-9a-f]")}
    extra = {address}.intersection(PCA9685.ADDRESSES)
    for each in plugged | {*SENSORS, *(board.address for board in BOARDS.values())} | extra:
        file = chip_file(folder, each)
        chip = chip_at(each) if each == address else chip_in(file, each)
        new = file.with_suffix(f".{os.getpid()}")
        new.write_bytes(chip.POWER_ON)
        new.replace(file)  # at once, for the processes that use the chip


class FakeBus:
    """Takes the place of ``smbus2.SMBus``: the methods that the drivers use, and the OSErrors of the kernel.

    folder: made, with every known chip in it, if it does not exist or holds only the buses of namespaces.
    address: of one more chip in a folder that is made, as for ``power_on``.
    """

    def __init__(self, folder: Folder, address: Optional[int] = None):
        self._folder = Path(folder)
        if is_new(self._folder):
            power_on(self._folder, address)
        self._seconds_per_bit = seconds_per_bit(self._folder / "clock")

    def read_byte_data(self, address: int, register: int) -> int:
        return self.read_i2c_block_data(address, register, 1)[0]

    def read_i2c_block_data(self, address: int, register: int, length: int) -> List[int]:
        fail_if_asked(f"{self._folder}/0x{address:02x}.fail")
        return self._transfer(address, 3 + length,
                              lambda chip, registers: chip.read(registers, register, length))

    def write_byte_data(self, address: int, register: int, value: int) -> None:
        self.write_i2c_block_data(address, register, [value])

    def write_i2c_block_data(self, address: int, register: int, data: Sequence[int]) -> None:
        if len(data) > 32:
            raise ValueError("an SMBus block holds 32 bytes at most")
        cut = number_in(f"{self._folder}/0x{address:02x}.cut")
        if cut is None:
            fail_if_asked(f"{self._folder}/0x{address:02x}.fail")
        sent = data[:cut]
        self._transfer(address, 2 + len(sent), lambda chip, registers: chip.write(registers, register, sent))
        if cut is not None:
            os.unlink(f"{self._folder}/0x{address:02x}.cut")
            raise no_answer()

    def close(self) -> None:
        """Nothing stays open between transfers."""

    def _transfer(self, address, wire_bytes, action):
        """Act on the chip's registers and store them at once at the STOP, when the wire has carried all bytes."""
        end = time.perf_counter() + (2 + 9 * wire_bytes) * self._seconds_per_bit
        file = f"{self._folder}/0x{address:02x}"  # pathlib would take longer than all the rest
        try:
            descriptor = open_file(file, os.O_RDWR)
        except FileNotFoundError:
            raise no_answer() from None
        try:
            if self._seconds_per_bit:
                time.sleep(max(0.0, end - time.perf_counter()))
            chip = chip_in(descriptor, address)
            check_chip(descriptor, file, len(chip.POWER_ON))
            registers = bytearray(os.pread(descriptor, len(chip.POWER_ON), 0))
            result = action(chip, registers)
            if result is None:  # a write; the file's time is then that of the last write
                os.pwrite(descriptor, registers, 0)
            return result
        except FileNotFoundError:  # unplugged, or a brown-out, before the STOP
            raise no_answer() from None
        finally:
            os.close(descriptor)


def is_new(folder: Path) -> bool:
    """Return whether nothing was ever plugged in there: it does not exist, or holds only the buses of namespaces."""
    try:
        with os.scandir(folder) as entries:
            are_folders = [entry.is_dir() for entry in entries]
    except FileNotFoundError:
        return True
    return bool(are_folders) and all(are_folders)


def seconds_per_bit(clock: Path) -> float:
    """Return the time that a bit takes by the file ``clock``, which holds the clock in Hz; 0 without such a file."""
    text = read_text(clock)
    if text is None:
        return 0.0
    try:
        frequency = float(text)
    except ValueError:
        frequency = 0.0
    if not CLOCK_RANGE[0] <= frequency <= CLOCK_RANGE[1]:
        raise BusError(f"{clock} must hold the clock of the bus in Hz, 10 to 10000000, not {text.strip()!r}",
                       "Write such a number into it, or delete it.", errno.EINVAL)
    return 1 / frequency


def chip_in(file: Union[int, Path], address: Optional[int]) -> type:
    """Return the class of the chip in a file, which may be open or missing: an INA219 by its size or its address."""
    try:
        size = os.stat(file).st_size
    except FileNotFoundError:
        size = 0
    is_sensor = address in SENSORS and size != len(PCA9685.POWER_ON)
    return INA219 if is_sensor or size == len(INA219.POWER_ON) else chip_at(address)


def chip_at(address: Optional[int]) -> type:
    """Return the class of a motor board's chip at this address: a board's own, or a PCA9685; None: the serial port."""
    return next((chip_class(board.chip) for board in BOARDS.values() if board.address == address), PCA9685)


def plug_in_advice(folder: Folder, address: int) -> str:
    """Return how to plug a motor board's chip in at an address where there is none."""
    if address not in PCA9685.ADDRESSES:
        return "A fake motor board is at 0x40 to 0x77."
    extra = None if address in [board.address for board in BOARDS.values()] else address
    return f"To plug it in: {power_on_command(folder, extra)}"


def number_in(request: str) -> Optional[int]:
    """Return the whole number, 0 or more, in the file ``request``; None if there is no file, or no such number."""
    if not os.path.exists(request):
        return None
    try:
        return max(0, int(read_text(request) or ""))
    except ValueError:  # it is being written
        return None


def fail_if_asked(request: str) -> None:
    """Fail as long as the file ``request`` holds a number above 0."""
    remaining = number_in(request)
    if remaining:
        Path(request).write_text(str(remaining - 1))
        raise no_answer()
    if remaining == 0:
        os.unlink(request)


def no_answer() -> OSError:
    """Return what the kernel raises when nobody acknowledges the address."""
    return OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
