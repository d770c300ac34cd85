"""Power every chip of a fake bus on again."""

import argparse
import sys

from ..text import printable
from . import default_folder
from .bus import power_on

parser = argparse.ArgumentParser(prog="python3 -m jetbot.fake", description=__doc__)
parser.add_argument("folder", nargs="?", help="the folder that is the bus (default: fake_i2c in ROS's home)")
folder = parser.parse_args().folder or default_folder()
try:
    power_on(folder)
except (OSError, ValueError) as error:
    sys.exit(printable(f"The fake bus {folder} cannot be powered on: {error}"))
