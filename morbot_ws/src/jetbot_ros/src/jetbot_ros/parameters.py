"""A parameter is one row: for a node, its launch file, YAML comments, command lines and the docs."""

from typing import Dict, NamedTuple

from jetbot import InvalidValue
from jetbot.kinds import Kind, check_duties


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
        raise InvalidValue(f"there is no parameter {unknown[0]}", f"The parameters are {', '.join(parameters)}.")
    for name, row in parameters.items():
        if name in values:
            row.kind.check(f"the parameter {name}", values[name])
    values = {name: values.get(name, row.default) for name, row in parameters.items()}
    if "max_duty" in values:
        check_duties(values["min_duty"], values["max_duty"])
    return values


def given(values: Dict[str, object]) -> Dict[str, object]:
    """Return the values without those that are "", as a launch file passes on what was not typed."""
    return {name: value for name, value in values.items() if value != ""}
