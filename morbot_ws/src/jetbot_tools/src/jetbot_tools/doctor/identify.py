"""Which chip answers at an I2C address, and which motor boards it can be. Chips are only read."""

from typing import List, Optional, Type

from jetbot.boards import BOARDS, MotorDriver
from jetbot.i2c import I2CDevice
from jetbot.supply import CONFIGURATION, read_word

# CONFIGURATION of the power monitors, 16 bits, at power-on (Texas Instruments SBOS448, SBOS576).
CONFIGURATIONS = {0x399F: "INA219", 0x7127: "INA3221"}
MONITOR_ADDRESSES = range(0x40, 0x50)


# Not from 0x70 on: a read begins with the byte of a register, which would switch a multiplexer (TCA9548A).
JUMPER_ADDRESSES = range(0x40, 0x70)


def jumper_addresses(board: str = "") -> List[int]:
    """Return the JUMPER_ADDRESSES that a board's jumpers select; all of them if none is named."""
    return [address for address in JUMPER_ADDRESSES if not board or address in BOARDS[board].jumpers]


def driver_for(chip: I2CDevice) -> Optional[Type[MotorDriver]]:
    """Return the driver of the motor board that the chip belongs to, None for any other chip; raise JetbotError.

    At a JetBot's own address, any other chip is taken for its board's: Linux's test chip, i2c-stub, holds only zeros.
    """
    for driver in dict.fromkeys(row.driver for row in BOARDS.values()):
        if driver.recognizes(chip):
            return driver
    return BOARDS["jetbot"].driver if chip.address == BOARDS["jetbot"].address else None


def power_monitor(chip: I2CDevice) -> str:
    """Return "INA219" or "INA3221" for one as it is at power-on, "" for any other chip; raise JetbotError."""
    if chip.address not in MONITOR_ADDRESSES:
        return ""
    return CONFIGURATIONS.get(read_word(chip, CONFIGURATION), "")


def boards_with(driver: Optional[Type[MotorDriver]], address: int) -> List[str]:
    """Return the boards with this driver whose address this is, then those whose jumpers select it."""
    own = [board for board, row in BOARDS.items() if row.driver is driver and row.address == address]
    return own + [board for board, row in BOARDS.items()
                  if row.driver is driver and address in row.jumpers and board not in own]
