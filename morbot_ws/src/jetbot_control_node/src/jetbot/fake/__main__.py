"""``python3 -m jetbot.fake [FOLDER]``: power every chip of a fake bus on again."""

import sys

from . import default_folder
from .bus import power_on

power_on(sys.argv[1] if len(sys.argv) > 1 else default_folder())
