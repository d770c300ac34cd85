"""A node's parameters: a row each, checked; their values from the command line (_name:=value), then from the master.

rospy puts the typed ones on the master, where they outlive the node and reach the next one. These nodes keep them.
"""

import contextlib
import sys
from typing import Collection, Dict, List, NamedTuple

import yaml

from jetbot import InvalidValue
from jetbot.kinds import Kind
from jetbot.text import closest

from .launcher import LAUNCHED


class Parameter(NamedTuple):
    """A row: the default, what a value must be, what it means, and its unit."""

    default: object
    kind: Kind
    doc: str
    unit: str = ""


def check_values(values: Dict[str, object], parameters: Dict[str, Parameter]) -> Dict[str, object]:
    """Return all parameters: the values that are given, else the defaults. Raise InvalidValue for a bad value."""
    values = given(values)
    unknown = sorted(set(values) - set(parameters), key=str)
    if unknown:
        meant = closest(str(unknown[0]), parameters)
        raise InvalidValue(f"there is no parameter {unknown[0]}",
                           f"Do you mean {meant}?" if meant else f"The parameters are {', '.join(parameters)}.")
    for name, row in parameters.items():
        if name in values:
            row.kind.check(f"the parameter {name}", values[name])
    return {name: values.get(name, row.default) for name, row in parameters.items()}


def given(values: Dict[str, object]) -> Dict[str, object]:
    """Return the values without those that are "", as a launch file passes on what was not typed."""
    return {name: value for name, value in values.items() if value != ""}


def public_words() -> List[str]:
    """Return the command line without private parameters, for rospy.init_node."""
    return [word for word in sys.argv if not is_private(word)]


def private_parameters(node: str, on_master: object, known: Collection[str]) -> Dict[str, object]:
    """Return the private parameters of the node of this name. on_master: those that the master has.

    known: the names that there are. Raise InvalidValue for a word of the command line that is no parameter, or has lost
    its underscore, and for an unknown name that somebody has put on the master.
    """
    typed = {}
    for before, word in zip(sys.argv, sys.argv[1:]):
        if before.endswith(":=") and ":=" not in word:
            raise InvalidValue(f"{before} and {word} are two words", f"Type them as one: {before}{word}")
        typed.update(parse_word(word, known))
    stored = from_master(on_master, LAUNCHED)
    unknown = [] if LAUNCHED else sorted(set(stored) - set(known))  # roslaunch would put it there again
    if unknown:
        raise InvalidValue(f"the ROS master holds {unknown[0]} for this node, which is no parameter",
                           f"Type: rosparam delete {node}/{unknown[0]}")
    return {**stored, **typed}


def fake_advice(name: str) -> str:
    """Return how to select "fake" for a parameter of this node: by a launch argument, or a word after its name."""
    return f"add: {'' if LAUNCHED else '_'}{name}:=fake"


def parse_word(word: str, known: Collection[str]) -> Dict[str, object]:
    """Return the parameter in a word such as _board:=sparkfun; nothing for a word of rospy's, such as __ns:=red."""
    name, separator, text = word.partition(":=")
    if is_private(word):
        return {name[1:]: plain_value(text)} if text.strip() else {}
    if separator and name not in known:
        return {}
    name, _, value = word.lstrip("-_").replace(":=", "=").partition("=")
    name = name.replace("-", "_")
    raise InvalidValue(f"the node does not understand {word}",
                       f"Type it as _{name}:={value or 'VALUE'}" if name in known else "Type it as _NAME:=VALUE")


def plain_value(text: str) -> object:
    """Return the number, bool or text that YAML sees in a text; the text itself where YAML sees something else."""
    with contextlib.suppress(yaml.YAMLError, ValueError, RecursionError):
        value = yaml.safe_load(text)
        return text if isinstance(value, (dict, list)) else value
    return text


def is_private(word: str) -> bool:
    """Return whether a word gives a private parameter, whose name follows one underscore."""
    return ":=" in word and word.startswith("_") and not word.startswith("__")


def from_master(on_master: object, launched: bool) -> Dict[str, object]:
    """Return the parameters on the master that are meant for this node. launched: whether roslaunch has started it.

    Those of an earlier launch are not: among them is a "" for each argument that was not typed.
    """
    if not isinstance(on_master, dict) or ("" in on_master.values() and not launched):
        return {}
    return on_master
