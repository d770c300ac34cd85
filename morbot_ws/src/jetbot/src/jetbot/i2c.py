"""The edge to the I2C bus: which bus a name means, and one sentence for each failure of a transfer."""

import errno
import math
import re
import time
from typing import Any, List, Sequence, Union

from . import fake
from .errors import EXHAUSTED, BusError, BusStuck, FatalError, InvalidValue, JetbotError, NoAnswer, OutOfResources
from .host import bus_advice, kernel_driver, permission_advice

TRIES = 3  # a single failed transfer is noise; three in a row are a fault


class I2CDevice:
    """The registers of one chip. A failed transfer is repeated; one that keeps failing raises a BusError.

    bus: N for /dev/i2c-N, ``fake`` or ``fake:FOLDER``; address: 7 bits.
    chip: the class in ``fake.chips`` that simulates this one, "" for any: a new fake bus has it at the address, and one
    with another chip there raises NoAnswer.
    transfers, errors: how many transfers were tried, and how many of them failed.
    tries: how often a transfer is tried.
    time_limit: s that a transfer may take. The second one in a row that takes longer raises FatalError; those after it
    do not, so that the wheels can be stopped.
    The bus is opened at the first transfer, and again after a failure. Raises OutOfResources if it cannot be.
    """

    tries = TRIES
    time_limit = math.inf

    def __init__(self, bus: Union[int, str], address: int, chip: str = ""):
        self.name = bus_name(bus)
        self.address, self._chip = address, chip
        self.transfers = self.errors = 0
        self._smbus: Any = None
        self._slow = 0  # transfers in a row that took too long; a busy computer holds up one, hardly two

    def read(self, register: int) -> int:
        """Return the byte in a register."""
        return self._transfer("read_byte_data", register)

    def read_block(self, register: int, length: int) -> List[int]:
        """Return the bytes in ``length`` registers, 32 at most, starting at this one."""
        return self._transfer("read_i2c_block_data", register, length)

    def write(self, register: int, data: Sequence[int]) -> None:
        """Write 1 to 32 bytes, starting at this register."""
        if len(data) == 1:
            self._transfer("write_byte_data", register, data[0])
        else:
            self._transfer("write_i2c_block_data", register, list(data))

    def close(self) -> None:
        """Close the bus; the next transfer opens it again."""
        if self._smbus is not None:
            self._smbus.close()
            self._smbus = None

    def _transfer(self, method: str, *arguments: Any) -> Any:
        for _ in range(self.tries):
            try:
                self._smbus = self._smbus or open_bus(self.name, self.address, self._chip)
                self.transfers += 1
                start = time.monotonic()
                result = getattr(self._smbus, method)(self.address, *arguments)
            except BusError:
                raise  # has its sentence already
            except OSError as error:
                self.errors += 1
                self.close()
                failure = error
                if error.errno == errno.ETIMEDOUT:
                    break  # a stuck bus takes a second for each try, Linux's default for an adapter
            else:
                self._check_duration(time.monotonic() - start)
                return result
        raise explain(failure, self.name, self.address, self._chip) from None

    def _check_duration(self, duration: float) -> None:
        self._slow = self._slow + 1 if duration > self.time_limit else 0
        if self._slow == 2:
            raise FatalError(f"the bus {self.name} is too slow to stop the robot in time: {duration:.2f} s a transfer",
                             "Switch the robot off and on, and check the wires.")


def bus_name(bus: Union[int, str]) -> str:
    """Return ``/dev/i2c-N`` for a number and ``fake:FOLDER`` for a fake bus; raise InvalidValue for anything else."""
    text = fake.expand(str(bus))
    number = re.fullmatch(r"(?:/dev/i2c-)?(\d{1,7})", text, re.ASCII)
    if number:
        return f"/dev/i2c-{int(number[1])}"
    if fake.folder_of(text):
        return text
    raise InvalidValue(f"an I2C bus cannot be {bus!r}", "Give a number (1 for /dev/i2c-1), fake, or fake:FOLDER.")


def open_bus(name: str, address: int, chip: str = "") -> Any:
    """Return the bus with this ``bus_name``, with the methods of smbus2.SMBus. chip: there, as for I2CDevice."""
    folder = fake.folder_of(name)
    if folder:
        from .fake.bus import FakeBus
        return FakeBus(folder, address, chip)
    try:
        from smbus2 import SMBus  # here: a computer without a bus does not need it
    except ImportError:
        raise BusError("the Python package smbus2 is missing", "Install it: sudo apt install python3-smbus2") from None
    return SMBus(int(name[len("/dev/i2c-"):]))


def explain(error: OSError, bus: str, address: int, chip: str = "") -> JetbotError:
    """Return the BusError for an OSError of the bus, or OutOfResources. chip: as for I2CDevice."""
    if error.errno in EXHAUSTED:
        return OutOfResources(error.errno)
    folder = fake.folder_of(bus)
    if folder:
        return explain_fake(error, folder, address, chip)
    if error.errno == errno.EBUSY:
        return explain_held(bus, address)
    if error.errno == errno.ENOENT:
        return BusError(f"there is no I2C bus {bus}", bus_advice(), errno.ENOENT, option="i2c_bus")
    if error.errno == errno.EACCES:
        return BusError(f"no permission to open {bus}", permission_advice(bus, "i2c"), errno.EACCES)
    if error.errno == errno.ETIMEDOUT:
        return BusStuck(f"the bus {bus} is stuck", "Switch the robot off and on, and check the wires.", errno.ETIMEDOUT)
    advice = f"{address_advice(address)}Is the motor board plugged in and its battery on? {bus_advice()}"
    return NoAnswer(f"no answer from 0x{address:02x} on {bus}", advice, error.errno, option="i2c_bus")


def explain_held(bus: str, address: int) -> BusError:
    """Return the BusError for a chip that a kernel driver holds; NoAnswer for one that cannot be the motor board."""
    device = f"{bus[len('/dev/i2c-'):]}-{address:04x}"
    driver = kernel_driver(device)
    reason = f"0x{address:02x} on {bus} is in use by {f'the kernel driver {driver}' if driver else 'a kernel driver'}"
    if driver.startswith("ina"):  # ina2xx, ina3221 (hwmon), ina3221x (Jetson Linux 32)
        return NoAnswer(reason, f"That chip measures the supply, and drives no motor. {bus_advice()}", errno.EBUSY)
    release = f"echo {device} | sudo tee /sys/bus/i2c/drivers/{driver}/unbind"
    return BusError(reason, f"If it is the motor board, release it: {release}" if driver else "Unload that driver.",
                    errno.EBUSY)


def explain_fake(error: OSError, folder: str, address: int, chip: str) -> BusError:
    """Return the BusError for an OSError of a fake bus."""
    if error.errno in (errno.EROFS, errno.EACCES, errno.ENOTDIR, errno.ENOSPC):
        return BusError(f"the fake bus fake:{folder} cannot be used: {error.strerror}",
                        "Name another folder: fake:FOLDER", error.errno)
    from .fake.bus import plug_in_advice  # here: no real robot needs it
    return NoAnswer(f"no answer from 0x{address:02x} on fake:{folder}",
                    address_advice(address) + plug_in_advice(folder, address, chip), error.errno)


def address_advice(address: int) -> str:
    """Return a question if the address can be a motor board's whose 0x was left out, such as 61 for 0x61; else ""."""
    return f"Do you mean 0x{address}? " if 40 <= address < 0x40 else ""
