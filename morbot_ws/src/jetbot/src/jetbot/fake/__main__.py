"""Power every chip of a fake bus on again."""

import argparse
import sys

from ..kinds import address_of, is_address
from ..text import printable
from . import default_folder
from .bus import power_on
from .chips import Chip, chip_class

parser = argparse.ArgumentParser(prog="python3 -m jetbot.fake", description=__doc__)
parser.add_argument("folder", nargs="?", help="the folder that is the bus (default: fake_i2c in ROS's home)")
parser.add_argument("--i2c-address", metavar="ADDRESS", help="plug a chip in at this address too, such as 0x61")
parser.add_argument("--chip", default="PCA9685", help="which one (default: PCA9685)",
                    choices=[chip.__name__ for chip in Chip.__subclasses__() if chip.ADDRESSES])
options = parser.parse_args()
folder, address = options.folder or default_folder(), options.i2c_address
possible = chip_class(options.chip).ADDRESSES
if address is not None and not (is_address(address) and address_of(address) in possible):
    parser.error(f"--i2c-address must be an address from 0x{min(possible):02x} to 0x{max(possible):02x}")
try:
    power_on(folder, address and address_of(address), options.chip)
except (OSError, ValueError) as error:
    sys.exit(printable(f"The fake bus {folder} cannot be powered on: {error}"))
