"""Programs of blocks, as tests write them."""

import json
from typing import Optional, Tuple


def num(value: float) -> dict:
    """Return an input with a number."""
    return {"block": {"type": "math_number", "fields": {"NUM": value}}}


def block(kind: str, fields: Optional[dict] = None, **inputs: dict) -> dict:
    """Return a block with these inputs."""
    return {"type": kind, "fields": fields or {}, "inputs": inputs}


def plug(kind: str, fields: Optional[dict] = None, **inputs: dict) -> dict:
    """Return an input with such a block."""
    return {"block": block(kind, fields, **inputs)}


def chain(*blocks: dict) -> dict:
    """Return an input with these statements, one below the other."""
    below = None
    for each in reversed(blocks):
        below = {"block": {**each, **({"next": below} if below else {})}}
    return below


def program(*blocks: dict, functions: Tuple[dict, ...] = (), variables: str = "") -> dict:
    """Return a program. variables: their names, of one letter each, which are their ids."""
    start = {"type": "robot_start", "x": 20, "y": 20, **({"next": chain(*blocks)} if blocks else {})}
    return {"blocks": {"languageVersion": 0, "blocks": [start, *functions]},
            "variables": [{"name": name, "id": name} for name in variables]}


def show(value: dict) -> dict:
    """Return a block that prints this input."""
    return block("robot_print", VALUE=value)


def let(name: str, value: dict) -> dict:
    """Return a block that sets a variable."""
    return block("variables_set", {"VAR": {"id": name}}, VALUE=value)


def var(name: str) -> dict:
    """Return an input with a variable."""
    return plug("variables_get", {"VAR": {"id": name}})


def drive(x: float, seconds: float) -> dict:
    """Return a block that drives straight."""
    return block("robot_drive", X=num(x), SECONDS=num(seconds))


def set_motion(x: float, z: float) -> dict:
    """Return a block that sets x and z."""
    return block("robot_set", X=num(x), Z=num(z))


def wait(seconds: float) -> dict:
    """Return a block that waits."""
    return block("robot_wait", SECONDS=num(seconds))


def calculate(operator: str, left: dict, right: dict) -> dict:
    """Return an input with an arithmetic operation."""
    return plug("math_arithmetic", {"OP": operator}, A=left, B=right)


def as_file(folder, blocks) -> str:
    """Write a program, or a text, into a file; return its path."""
    file = folder / "program.json"
    file.write_text(blocks if isinstance(blocks, str) else json.dumps(blocks))
    return str(file)
