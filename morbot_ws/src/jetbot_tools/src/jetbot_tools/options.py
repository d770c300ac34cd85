"""Command lines of the tools, made from the rows of the controller's parameters."""

import os
import re
import sys
from argparse import ArgumentParser, Namespace
from typing import List, Union

from jetbot import InvalidValue, fake
from jetbot.kinds import address_of
from jetbot.text import closest, printable
from jetbot_control_node.parameters import PARAMETERS

from .commands import launch

LAUNCH_ARGUMENTS = {*PARAMETERS, "config", "robot_name"}


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


def parse(parser: ArgumentParser, arguments: List[str]) -> Namespace:
    """Return the options. An unknown word ends the program with one sentence that says what was probably meant."""
    options, unknown = parser.parse_known_args(as_options(arguments))
    if unknown:
        typed = next(word for word in arguments if as_options([word])[0] in unknown)
        name, value = re.match(r"[-_]*([\w-]*)[\s:=]*(.*)", typed, re.S).groups()
        names = [option.strip("-").replace("-", "_") for option in parser._option_string_actions]
        name = name.replace("-", "_")
        if name in LAUNCH_ARGUMENTS and name not in names:
            sys.exit(printable(f"{name} is an argument of the controller, not of {parser.prog}. Leave it out here; it "
                               f"belongs to: {launch(**{name: value or 'VALUE'})}"))
        meant = closest(name, names)
        advice = f"Did you mean {meant}:={value or 'VALUE'}?" if meant in PARAMETERS else f"See {parser.prog} --help"
        sys.exit(printable(f"There is no argument {typed}. {advice}"))
    check_option("board", options)
    check_option("i2c_address", options)
    if getattr(options, "i2c_address", None) is not None:
        options.i2c_address = address_of(options.i2c_address)
    return options


def check_option(name: str, options: Namespace) -> None:
    """End the program with one sentence if an option has a value that its parameter cannot have."""
    value = getattr(options, name, None)
    try:
        if value is not None:
            PARAMETERS[name].kind.check(f"the parameter {name}", value)
    except InvalidValue as error:
        sys.exit(str(error))


def place_name(text: str) -> Union[int, str]:
    """Return a number as an int, a fake bus or port with its absolute path, any other text unchanged."""
    return int(text) if re.fullmatch(r"\d{1,7}", text, re.ASCII) else fake.expand(text)
