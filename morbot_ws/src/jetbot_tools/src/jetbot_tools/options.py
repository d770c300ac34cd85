"""Command lines: those of the tools, made from the controller's parameters, and the one to type next."""

import os
import re
import shlex
import sys
from argparse import ArgumentParser, ArgumentTypeError, Namespace
from typing import Iterable, List, Union

from jetbot import InvalidValue, fake
from jetbot.host import by_morbot, in_shell
from jetbot.kinds import address_of
from jetbot.text import closest, printable
from jetbot_control_node.parameters import PARAMETERS


def launch_command(**typed: object) -> str:
    """Return the command that starts the controller with these parameters; one at its default is left out.

    It works where this program was started: in a shell that knows ROS, or after ./morbot.
    """
    words = [f"{name}:={'fake' if value == fake.expand('fake') else value}" for name, value in typed.items()
             if name not in PARAMETERS or value != PARAMETERS[name].default]
    return in_shell(shlex.join(["roslaunch", "jetbot_control_node", "jetbot_controller.launch", *words]))


def fake_advice(name: str) -> str:
    """Return how to select "fake" for a parameter of the tools."""
    return f"add: {name}:=fake"


def add_options(parser: ArgumentParser, **meaning: str) -> None:
    """Add an option for each parameter named; one that is not given is JETBOT_<NAME>, else None.

    meaning: what None means, for the help; "" if that is the parameter's own default.
    """
    for name, default in meaning.items():
        row = PARAMETERS[name]
        parser.add_argument(f"--{name.replace('_', '-')}", type=lambda text, name=name: checked_value(name, text),
                            default=os.environ.get(f"JETBOT_{name.upper()}") or None,
                            help=f"{row.doc} (default: {default or row.default})".replace("%", "%%"))


def checked_value(name: str, text: str) -> Union[int, str]:
    """Return a parameter's value: a fake bus or port with its absolute path, a number as an int.

    Raise ArgumentTypeError for one that the parameter cannot have.
    """
    value = int(text) if re.fullmatch(r"\d{1,7}", text, re.ASCII) else fake.expand(text)
    try:
        PARAMETERS[name].kind.check(f"the parameter {name}", value)
    except InvalidValue as error:
        raise ArgumentTypeError(str(error)) from None
    return address_of(value) if name == "i2c_address" else value


def as_options(arguments: List[str]) -> List[str]:
    """Return the arguments with i2c_bus:=7 and _i2c_bus:=7, as ROS writes them, as --i2c-bus=7."""
    return [re.sub(r"^_?(\w+):=", lambda name: f"--{name[1].replace('_', '-')}=", argument) for argument in arguments]


def parse(parser: ArgumentParser, arguments: List[str]) -> Namespace:
    """Return the options. A bad word ends the program with a sentence that says what was probably meant."""
    parser.error = lambda message: sys.exit(printable(f"{parser.prog}: {message}"))
    options, unknown = parser.parse_known_args(as_options(arguments))
    if unknown:
        typed = next(word for word in arguments if as_options([word])[0] in unknown)
        program = by_morbot(parser.prog.partition(".")[0], parser.prog)
        sys.exit(printable(unknown_word(typed, program, vars(options))))
    return options


def unknown_word(typed: str, program: str, names: Iterable[str]) -> str:
    """Return what to type instead of a word that the program, which has options of these names, does not know."""
    name, value = re.match(r"[-_]*([\w-]*)[\s:=]*(.*)", typed, re.S).groups()
    meant = closest(name.replace("-", "_"), names)
    advice = f"Did you mean {meant}:={value or 'VALUE'}?" if meant in PARAMETERS else f"See {program} --help"
    return f"There is no argument {typed}. {advice}"
