"""The edge to the I2C bus: which bus a name means, and what to do when a transfer fails."""

import errno

from .errors import BusError, InvalidValue
from .host import how_to_open, which_buses

TRIES = 3  # a single failed transfer is noise; three in a row are a fault


class I2CDevice:
    """One chip: reads and writes its registers, tries again, and puts failures into words.

    bus: N for /dev/i2c-N, ``fake:FOLDER``, or ``fake`` (see ``fake_i2c``); address: 7 bits.
    Raises BusError. The bus is opened at the first transfer, and anew after a failure.
    """

    def __init__(self, bus, address):
        self.name = bus_name(bus)
        self.address = address
        self.transfers = self.errors = 0
        self._smbus = None

    def read(self, register):
        """The byte in a register."""
        return self._transfer(lambda smbus: smbus.read_byte_data(self.address, register))

    def read_block(self, register, length):
        """The bytes in ``length`` registers (at most 32), from this one on."""
        return bytes(self._transfer(lambda smbus: smbus.read_i2c_block_data(self.address, register, length)))

    def write(self, register, data):
        """Write 1 to 32 bytes, from this register on."""
        if len(data) == 1:
            self._transfer(lambda smbus: smbus.write_byte_data(self.address, register, data[0]))
        else:
            self._transfer(lambda smbus: smbus.write_i2c_block_data(self.address, register, list(data)))

    def close(self):
        """Close the bus; the next transfer opens it again."""
        if self._smbus is not None:
            self._smbus.close()
            self._smbus = None

    def _transfer(self, call):
        for _ in range(TRIES):
            try:
                self._smbus = self._smbus or open_bus(self.name)
                self.transfers += 1
                return call(self._smbus)
            except BusError:
                raise  # already in words
            except OSError as error:
                self.errors += 1
                self.close()
                failure = error
                if error.errno == errno.ETIMEDOUT:
                    break  # a stuck bus takes a second for each try
        raise explain(failure, self.name, self.address) from None


def bus_name(bus):
    """``/dev/i2c-N`` for a number, ``fake:FOLDER`` for a fake bus; anything else is an InvalidValue."""
    text = str(bus)
    if text.isascii() and text.isdigit():
        return f"/dev/i2c-{int(text)}"
    if text == "fake":
        from .fake.bus import default_folder
        return f"fake:{default_folder()}"
    if fake_folder(text):
        return text
    raise InvalidValue(f"i2c_bus cannot be {bus!r}", "Give a number (1 for /dev/i2c-1), fake, or fake:FOLDER.")


def fake_folder(bus):
    """FOLDER where the bus is ``fake:FOLDER``; None for any other."""
    return bus[len("fake:"):] or None if bus.startswith("fake:") else None


def open_bus(name):
    """The bus with this ``bus_name``, with the methods of smbus2.SMBus."""
    folder = fake_folder(name)
    if folder:
        from .fake.bus import FakeBus
        return FakeBus(folder)
    try:
        from smbus2 import SMBus  # here, so that a machine without a bus does not need it
    except ImportError:
        raise BusError("the Python package smbus2 is missing", "Install it: sudo apt install python3-smbus2") from None
    return SMBus(int(name[len("/dev/i2c-"):]))


def explain(error, bus, address):
    """The BusError that says what an OSError from the bus means and what to do."""
    reason, advice = {
        errno.ENOENT: (f"there is no I2C bus {bus}", which_buses()),
        errno.EACCES: (f"no permission to open {bus}", how_to_open(bus, "i2c")),
        errno.EBUSY: (f"0x{address:02x} on {bus} is taken by a driver of the kernel", "Unload that driver."),
        errno.ETIMEDOUT: (f"the bus {bus} is stuck", "Switch the robot off and on, and check the wires."),
    }.get(error.errno, (f"no answer from 0x{address:02x} on {bus}",
                        f"Is the motor board plugged in and its battery on? {which_buses()}"))
    folder = fake_folder(bus)
    if folder and error.errno in (errno.EROFS, errno.EACCES, errno.ENOTDIR, errno.ENOSPC):
        return BusError(f"the fake bus {bus} cannot be used: {error.strerror}", "Name another folder: fake:FOLDER",
                        error.errno)
    if folder:
        advice = f"To plug it in: python3 -m jetbot.fake {folder}"
    return BusError(reason, advice, error.errno)
