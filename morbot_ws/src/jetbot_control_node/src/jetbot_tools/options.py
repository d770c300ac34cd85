"""Command lines of the tools, made from the rows of the controller's parameters."""

import os
import re
from argparse import ArgumentParser
from typing import List, Union

from jetbot import fake
from jetbot_ros.parameters import PARAMETERS


def add_options(parser: ArgumentParser, **meaning: str) -> None:
    """Add an option for each parameter named; one that is not given is JETBOT_<NAME>, else None.

    meaning: what None means, for the help; "" if that is the parameter's own default.
    """
    for name, default in meaning.items():
        row = PARAMETERS[name]
        parser.add_argument(f"--{name.replace('_', '-')}", type=place_name,
                            default=os.environ.get(f"JETBOT_{name.upper()}") or None,
                            help=f"{row.doc} (default: {default or row.default})".replace("%", "%%"))


def as_options(arguments: List[str]) -> List[str]:
    """Return the arguments with i2c_bus:=7 and _i2c_bus:=7, as ROS writes them, as --i2c-bus=7."""
    return [re.sub(r"^_?(\w+):=", lambda name: f"--{name[1].replace('_', '-')}=", argument) for argument in arguments]


def place_name(text: str) -> Union[int, str]:
    """Return a number as an int, a fake bus or port with its absolute path, any other text unchanged."""
    return int(text) if re.fullmatch(r"\d{1,7}", text, re.ASCII) else fake.expand(text)
