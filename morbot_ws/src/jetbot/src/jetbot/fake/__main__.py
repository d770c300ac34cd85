"""Power every chip of a fake bus on again."""

import argparse
import sys

from ..kinds import address_of, is_address
from ..text import printable
from . import default_folder
from .bus import power_on
from .chips import PCA9685

parser = argparse.ArgumentParser(prog="python3 -m jetbot.fake", description=__doc__)
parser.add_argument("folder", nargs="?", help="the folder that is the bus (default: fake_i2c in ROS's home)")
parser.add_argument("--i2c-address", metavar="ADDRESS", help="plug a PCA9685 in at this address too, such as 0x61")
options = parser.parse_args()
folder, address = options.folder or default_folder(), options.i2c_address
if address is not None and not (is_address(address) and address_of(address) in PCA9685.ADDRESSES):
    parser.error("--i2c-address must be an address from 0x40 to 0x77")
try:
    power_on(folder, address and address_of(address))
except (OSError, ValueError) as error:
    sys.exit(printable(f"The fake bus {folder} cannot be powered on: {error}"))
