"""The robots of a class, as the teacher's computer knows them: FOLDER/CLASS/fleet.json."""

import json
import os
from pathlib import Path
from typing import Any, List, NamedTuple

from jetbot import InvalidValue, files
from jetbot.text import printable
from jetbot_ros.contract import COCKPIT_PORT

from .key import ROBOT_NAME, new_key, read_key, robot_key

FOLDER = "~/.ros/morbot_classes"
OWNER_ONLY = 0o700


class Entry(NamedTuple):
    """A robot. name: its own; address: where its page is, HOST or HOST:PORT; login: for ssh, USER@HOST, or ""."""

    name: str
    address: str
    login: str = ""

    @property
    def authority(self) -> str:
        """HOST:PORT of its page."""
        return self.address if ":" in self.address else f"{self.address}:{COCKPIT_PORT}"


class Fleet:
    """name: the class's; key: the class's key; robots: all entries. ``changed`` reads the file again."""

    def __init__(self, folder: str, name: str):
        self.name, self.path = name, Path(folder).expanduser() / name / "fleet.json"
        self._read_at: Any = None
        self.key, self.robots = "", []  # type: str, List[Entry]
        if not self.path.exists():
            self.key = new_key()
            self.save([])
        self.update()

    def key_of(self, robot: str) -> str:
        """Return the key of a robot."""
        return robot_key(self.key, robot)

    def update(self) -> None:
        """Read the file again if it has changed. Raise InvalidValue."""
        try:
            at = self.path.stat().st_mtime_ns
            if at == self._read_at:
                return
            content = json.loads(files.read(self.path))
            robots = [Entry(**each) for each in content["robots"]]
            key = read_key(content["key"])
            if not key or not all(ROBOT_NAME.fullmatch(each.name) for each in robots):
                raise ValueError
        except (OSError, ValueError, TypeError, KeyError) as error:
            raise InvalidValue(f"{printable(self.path)} cannot be read: {error}",
                               "Copy it back from a backup.") from None
        self.key, self.robots, self._read_at = key, robots, at

    def save(self, robots: List[Entry]) -> None:
        """Replace the robots, in the file too. Raises OSError."""
        self.path.parent.mkdir(OWNER_ONLY, parents=True, exist_ok=True)
        if not self.path.exists():
            os.close(os.open(self.path, os.O_CREAT | os.O_WRONLY, 0o600))
        files.replace(self.path, json.dumps({"key": self.key, "robots": [each._asdict() for each in robots]},
                                            indent=2).encode())
        self._read_at = None
