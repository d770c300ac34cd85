"""What makes a robot one of a class: its name, the class's, and its own key, in a file that only its user reads."""

import json
from pathlib import Path
from typing import NamedTuple, Optional

from jetbot import InvalidValue, files
from jetbot.text import printable

from .key import ROBOT_NAME, read_key

FILE = "~/.ros/morbot_robot.json"  # written by ./morbot robot


class Identity(NamedTuple):
    """robot: its name, which is its namespace; class_name: its class's; key: its own, see key.robot_key."""

    robot: str
    class_name: str
    key: str


def read(file: str = FILE) -> Optional[Identity]:
    """Return what the file says, or None if there is none. Raise InvalidValue."""
    path = Path(file).expanduser()
    if not path.exists():
        return None
    try:
        identity = Identity(**json.loads(files.read(path)))
    except (OSError, ValueError, TypeError) as error:
        raise invalid(path) from error
    if not (all(isinstance(each, str) for each in identity) and ROBOT_NAME.fullmatch(identity.robot)
            and read_key(identity.key) == identity.key):
        raise invalid(path)
    return identity


def invalid(path: Path) -> InvalidValue:
    """Return the error for a file that says nothing."""
    return InvalidValue(f"{printable(path)} is damaged", "Name the robot again: ./morbot robot NAME --class CLASS")


def write(identity: Identity, file: str = FILE) -> None:
    """Replace the file. Raises OSError."""
    path = Path(file).expanduser()
    path.parent.mkdir(parents=True, exist_ok=True)
    files.replace_secret(path, json.dumps(identity._asdict()).encode())
