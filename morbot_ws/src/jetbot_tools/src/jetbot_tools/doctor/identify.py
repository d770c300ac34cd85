"""Which chip answers at an I2C address, and which motor boards it can be. Chips are only read."""

from typing import List, NamedTuple

from jetbot.boards import BOARDS, scmd
from jetbot.i2c import I2CDevice
from jetbot.supply import CONFIGURATION, read_word

# Register: value at power-on, of a PCA9685's SUBADR1 to SUBADR3 (NXP data sheet, rev. 4). Motor programs leave them.
SUBADDRESSES = {0x02: 0xE2, 0x03: 0xE4, 0x04: 0xE8}

# CONFIGURATION of the power monitors, 16 bits, at power-on (Texas Instruments SBOS448, SBOS576).
CONFIGURATIONS = {0x399F: "INA219", 0x7127: "INA3221"}
MONITOR_ADDRESSES = range(0x40, 0x50)


class Family(NamedTuple):
    """The addresses that a board's jumpers select."""

    chip: str
    addresses: range
    board: str


# Adafruit's A0 to A4 add to 0x60, those of Waveshare's Motor Driver HAT to 0x40 (their user manuals); SparkFun's four
# configuration jumpers select 0x58 to 0x63 (main.c of its firmware).
FAMILIES = (Family("PCA9685", range(0x60, 0x78), "jetbot"), Family("PCA9685", range(0x40, 0x60), "waveshare_hat"),
            Family("SCMD", range(0x58, 0x64), "sparkfun"))

# Not from 0x70 on: a read begins with the byte of a register, which would switch a multiplexer (TCA9548A).
JUMPER_ADDRESSES = range(0x40, 0x70)


def jumper_addresses(board: str = "") -> List[int]:
    """Return the JUMPER_ADDRESSES that a board's jumpers select; all of them if none is named."""
    return [address for address in JUMPER_ADDRESSES
            if not board or any(address in row.addresses and BOARDS[row.board].address == BOARDS[board].address
                                for row in FAMILIES)]


def motor_chip(chip: I2CDevice) -> str:
    """Return "PCA9685" or "SCMD", "" for any other chip; raise JetbotError.

    At a JetBot's own address, any other chip is taken for a PCA9685: Linux's test chip, i2c-stub, holds only zeros.
    """
    if chip.read(scmd.ID) == scmd.ID_WORD:
        return "SCMD"
    known = all(chip.read(register) == value for register, value in SUBADDRESSES.items())
    return "PCA9685" if known or chip.address == BOARDS["jetbot"].address else ""


def power_monitor(chip: I2CDevice) -> str:
    """Return "INA219" or "INA3221" for one as it is at power-on, "" for any other chip; raise JetbotError."""
    if chip.address not in MONITOR_ADDRESSES:
        return ""
    return CONFIGURATIONS.get(read_word(chip, CONFIGURATION), "")


def boards_with(chip: str, address: int) -> List[str]:
    """Return the boards that have a chip ("" for none) and whose jumpers select an address."""
    own = [BOARDS[row.board].address for row in FAMILIES if row.chip == chip and address in row.addresses]
    return [board for board, row in BOARDS.items() if row.address in own]


def has_chip(board: str, chip: str) -> bool:
    """Return whether a board has a chip, whatever its address."""
    return BOARDS[board].address in [BOARDS[row.board].address for row in FAMILIES if row.chip == chip]
