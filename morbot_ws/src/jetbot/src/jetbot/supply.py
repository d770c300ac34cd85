"""The robot's supply, where a chip on the board's bus or the computer measures it. Both are only read."""

import itertools
import math
from functools import partial
from pathlib import Path
from typing import Callable, Dict, Iterator, NamedTuple, Optional, Union

from . import fake
from .errors import JetbotError
from .i2c import I2CDevice
from .serial_link import SerialLink

# TI's data sheet of the INA219, SBOS448: registers of 16 bits, the high byte first. Waveshare's JetBot has one at 0x41,
# Waveshare's UPS module at 0x42. A PCA9685, an INA226 or an INA3221 can have these addresses, too.
INA219_ADDRESSES = (0x41, 0x42)
CONFIGURATION, BUS_VOLTAGE = 0x00, 0x02
CONFIGURATION_MAX = 0x3FFF  # its two highest bits are 0 in an INA219; in an INA226 and an INA3221 one is set
BUS_VOLTAGE_LSB = 0.004     # V, from bit 3 on
VOLTAGE_MAX = 26.0          # V that these chips measure; a PCA9685 read as if it were one gives 29 V

# Files of hwmon that are not 0 after an undervoltage. A Raspberry Pi's: less than 4.63 V within the last 2 s. An
# Orin's: how often since its start ("Jetson Orin Nano Series" in NVIDIA's Jetson Linux Developer Guide, event OC1).
ALARMS = {"rpi_volt": "in0_lcrit_alarm", "soctherm_oc": "oc1_event_cnt"}

TRANSFER_TIME_LIMIT = 0.15  # s; a transfer takes less than a millisecond, and holds up the motors' for as long

EMPTY, FULL = 3.0, 4.2  # V, of a lithium-ion cell
DISCONNECTED = 2.5      # V, below which the protection circuit of a pack has switched it off
CELLS = 3               # of the pack in Waveshare's JetBot, in series
UPS_ADDRESS = 0x42      # Waveshare's UPS module has two cells; its demo takes 6.0 V for 0 % and 8.4 V for 100 %
UPS_MAX = 8.6           # V; another pack there has more


class Reading(NamedTuple):
    """What is known of the supply; NaN and None where it is not measured.

    voltage: V; percentage: charge of the battery in [0, 1], by a straight line from 3.0 to 4.2 V a cell: an estimate;
    undervoltage: whether the computer reports that its supply is too low.
    """

    voltage: float = math.nan
    percentage: float = math.nan
    undervoltage: Optional[bool] = None

    @property
    def battery(self) -> Dict[str, float]:
        """The readings of a robot's health that this gives: none without a battery."""
        return {} if math.isnan(self.percentage) else {"volts": self.voltage, "percent": 100 * self.percentage}

    def __str__(self) -> str:
        if self.undervoltage is not None:
            return "undervoltage" if self.undervoltage else "no undervoltage"
        return f"{self.voltage:.2f} V" + ("" if math.isnan(self.percentage) else f", {100 * self.percentage:.0f} %")


class Supply(NamedTuple):
    """A supply that is measured, and what measures it. ``read`` raises JetbotError."""

    sensor: str
    read: Callable[[], Reading]


def find_supply(link: Union[I2CDevice, SerialLink], sysfs: Path = Path("/sys")) -> Optional[Supply]:
    """Return the supply of the robot whose motor board is at this link; None if nothing measures it.

    A chip on the board's bus comes before what the computer reports. Fake hardware has no computer.
    """
    for supply in itertools.chain(on_bus(link), () if fake.folder_of(link.name) else on_computer(sysfs)):
        try:
            supply.read()
            return supply
        except JetbotError:
            continue
    return None


def on_bus(link: Union[I2CDevice, SerialLink]) -> Iterator[Supply]:
    """Yield a supply for each INA219 beside a motor board on an I2C bus."""
    for address in INA219_ADDRESSES:
        if link.address not in (None, address):
            chip = I2CDevice(link.name, address)
            chip.tries = 1  # the next reading is the second try
            chip.time_limit = TRANSFER_TIME_LIMIT
            if is_ina219(chip):
                yield Supply(f"INA219 at 0x{address:02x} on {chip.name}", partial(read_ina219, chip))
            else:
                chip.close()


def is_ina219(chip: I2CDevice) -> bool:
    """Return whether the chip answers, and may be an INA219."""
    try:
        return 0 < read_word(chip, CONFIGURATION) <= CONFIGURATION_MAX
    except JetbotError:
        return False


def read_ina219(chip: I2CDevice) -> Reading:
    """Return the voltage and the charge of the pack, by one transfer."""
    volts = voltage((read_word(chip, BUS_VOLTAGE) >> 3) * BUS_VOLTAGE_LSB, chip.name)
    return Reading(volts, percentage(volts, 2 if chip.address == UPS_ADDRESS and volts < UPS_MAX else CELLS))


def read_word(chip: I2CDevice, register: int) -> int:
    """Return what a register of 16 bits holds."""
    return int.from_bytes(bytes(chip.read_block(register, 2)), "big")


def percentage(volts: float, cells: int = CELLS) -> float:
    """Return the charge of a pack of so many cells in [0, 1]; NaN if there is no such pack."""
    cell = volts / cells
    return min(max((cell - EMPTY) / (FULL - EMPTY), 0.0), 1.0) if cell >= DISCONNECTED else math.nan


def on_computer(sysfs: Path) -> Iterator[Supply]:
    """Yield what Linux reports of the computer's own supply: a Jetson Nano's input of 5 V, other computers' alarm."""
    # NVIDIA's driver numbers the Nano's bus to its INA3221, and the channel of the input, POM_5V_IN, so.
    for file in sysfs.glob("bus/i2c/drivers/ina3221x/6-0040/iio*device*/in_voltage0_input"):
        yield Supply("ina3221x of this computer", partial(read_millivolts, file))
    for driver, name in ALARMS.items():
        for file in sysfs.glob(f"class/hwmon/hwmon*/{name}"):
            if (file.parent / "name").read_text().strip() == driver:
                yield Supply(f"{driver} of this computer", partial(read_alarm, file))


def read_millivolts(file: Path) -> Reading:
    """Return the voltage of a supply that is regulated, so that it says nothing of a battery."""
    return Reading(voltage(read_integer(file) / 1000, str(file)))


def read_alarm(file: Path) -> Reading:
    """Return whether there was an undervoltage, for as long as the driver of ALARMS says so."""
    return Reading(undervoltage=bool(read_integer(file)))


def read_integer(file: Path) -> int:
    """Return the number in a file of sysfs; raise JetbotError."""
    try:
        return int(file.read_text())
    except (OSError, ValueError) as error:
        raise JetbotError(f"{file} cannot be read: {getattr(error, 'strerror', error)}") from None


def voltage(volts: float, source: str) -> float:
    """Return the voltage in V; raise JetbotError for one that cannot have been measured. source: where it is from."""
    if not 0 <= volts <= VOLTAGE_MAX:
        raise JetbotError(f"the supply cannot have {volts:.1f} V, as {source} reports")
    return volts
