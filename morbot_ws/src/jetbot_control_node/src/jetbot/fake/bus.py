"""An I2C bus without hardware: a folder is the bus, a file in it is a chip, a byte of the file is a register.

Every process that opens the folder meets the same chips, and they stay powered when it ends. By hand:

    xxd FOLDER/0x60                        look at the registers
    rm FOLDER/0x60                         unplug the chip
    echo 5 > FOLDER/0x60.fail              let its next 5 transfers fail
    echo 100000 > FOLDER/clock             take as long as a bus of 100 kHz (read when the bus is opened)
    python3 -m jetbot.fake FOLDER      power every chip on anew: after an unplugging, or as a brown-out
"""

import errno
import os
import time
from pathlib import Path

from ..host import ros_home
from .chips import CHIPS

REGISTERS = 256


def default_folder(namespace="/"):
    """The folder that plain ``fake`` means: fake_i2c plus the node's namespace in ROS's home (~/.ros)."""
    return ros_home() / "fake_i2c" / namespace.strip("/")


def chip_file(folder, address):
    """The file that stands for the chip at this address."""
    return Path(folder, f"0x{address:02x}")


def power_on(folder):
    """Give every chip its power-on registers; make the folder and plug in the chips that are not there."""
    Path(folder).mkdir(parents=True, exist_ok=True)
    for address, chip in CHIPS.items():
        arriving = chip_file(folder, address).with_suffix(f".{os.getpid()}")
        arriving.write_bytes(chip.POWER_ON)
        arriving.replace(chip_file(folder, address))


class FakeBus:
    """Stands in for ``smbus2.SMBus``: the methods that the drivers use, and the OSErrors of the kernel.

    folder: made, with every known chip on it, when it is not there.
    """

    def __init__(self, folder):
        self._folder = Path(folder)
        if not self._folder.exists():
            power_on(self._folder)
        clock = self._folder / "clock"
        self._seconds_per_bit = 1 / float(clock.read_text()) if clock.exists() else 0

    def read_byte_data(self, address, register):
        return self._transfer(address, 4, lambda registers: registers[register])

    def read_i2c_block_data(self, address, register, length):
        return self._transfer(address, 3 + length, lambda registers: list(registers[register:register + length]))

    def write_byte_data(self, address, register, value):
        self.write_i2c_block_data(address, register, [value])

    def write_i2c_block_data(self, address, register, data):
        if len(data) > 32:
            raise ValueError("an SMBus block holds 32 bytes at most")
        self._transfer(address, 2 + len(data), lambda registers: CHIPS[address].write(registers, register, data))

    def close(self):
        """Nothing stays open between transfers."""

    def _transfer(self, address, wire_bytes, action):
        """Act on the chip's registers and store them at once, as the chip does at the STOP."""
        time.sleep((2 + 9 * wire_bytes) * self._seconds_per_bit)
        file = f"{self._folder}/0x{address:02x}"  # pathlib would take longer than all the rest
        fail_if_asked(f"{file}.fail")
        try:
            chip = os.open(file, os.O_RDWR)
        except FileNotFoundError:
            raise no_answer() from None
        try:
            registers = bytearray(os.pread(chip, REGISTERS, 0).ljust(REGISTERS, b"\0"))
            result = action(registers)
            if result is None:  # a write: it also sets the time since when nobody wrote
                os.pwrite(chip, registers, 0)
            return result
        finally:
            os.close(chip)


def fail_if_asked(request):
    """Fail as long as the file ``request`` holds a number above 0."""
    if not os.path.exists(request):
        return
    try:
        left = int(Path(request).read_text())
    except (FileNotFoundError, ValueError):  # ValueError: it is just being written
        return
    if left > 0:
        Path(request).write_text(str(left - 1))
        raise no_answer()
    os.unlink(request)


def no_answer():
    """What the kernel says when nobody acknowledges the address."""
    return OSError(errno.EREMOTEIO, os.strerror(errno.EREMOTEIO))
