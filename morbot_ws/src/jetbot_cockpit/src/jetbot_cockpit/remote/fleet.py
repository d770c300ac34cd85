"""The robots of a class, as the teacher's computer knows them: FOLDER/CLASS/fleet.json."""

import contextlib
import hashlib
import json
from pathlib import Path
from typing import Any, Dict, List, NamedTuple, Optional, Tuple

from jetbot import InvalidValue, files
from jetbot.text import printable
from jetbot_ros.contract import COCKPIT_PORT

from ..classroom.place import OWNER_ONLY
from .key import ROBOT_NAME, new_key, read_key, robot_key


class Entry(NamedTuple):
    """A robot. name: its own; address: where its page is, HOST or HOST:PORT; login: for ssh, USER@HOST, or "".

    last: HOST:PORT where it has proven its name last, "" if that is the address.
    """

    name: str
    address: str
    login: str = ""
    last: str = ""

    @property
    def authority(self) -> str:
        """HOST:PORT of its page."""
        return self.address if ":" in self.address else f"{self.address}:{COCKPIT_PORT}"

    @property
    def ssh(self) -> str:
        """``login`` with the host where it has proven its name last."""
        user, at, _ = self.login.rpartition("@")
        return user + at + self.last.rpartition(":")[0].strip("[]") if self.login and self.last else self.login

    @property
    def authorities(self) -> Tuple[str, ...]:
        """HOST:PORT of each place where it may be."""
        return tuple(dict.fromkeys([self.authority, *filter(None, [self.last])]))


class Fleet:
    """name: the class's; key: the class's key; robots: all entries. ``update`` reads the file again.

    removed: how often a robot of this name was taken from the list: after each time, the name has another key.
    For web.codes.Codes it is what a Classroom is for others: it keeps the hub's codes beside it.
    """

    def __init__(self, folder: str, name: str):
        self.name, self.path = name, Path(folder).expanduser() / name / "fleet.json"
        self._read_at: Any = None
        self.key, self.robots, self.removed = "", [], {}  # type: str, List[Entry], Dict[str, int]
        if not self.path.exists():
            self.key = new_key()
            self.save([])
        self.update()

    @property
    def id(self) -> str:
        """What pages know this class by: none that has another key."""
        return hashlib.sha256(f"class {self.key}".encode()).hexdigest()[:16]

    def key_of(self, robot: str) -> str:
        """Return the key of a robot; who has one from before it was removed is refused."""
        count = self.removed.get(robot, 0)
        return robot_key(self.key, f"{robot} {count}" if count else robot)

    def update(self) -> None:
        """Read the file again if it has changed. Raise InvalidValue."""
        try:
            at = self.path.stat().st_mtime_ns
            if at == self._read_at:
                return
            content = json.loads(files.read(self.path))
            robots = [Entry(**each) for each in content["robots"]]
            key, removed = read_key(content["key"]), {**content.get("removed", {})}
            if not key or not all(ROBOT_NAME.fullmatch(each.name) for each in robots) or not all(
                    type(count) is int for count in removed.values()):
                raise ValueError
        except (OSError, ValueError, TypeError, KeyError) as error:
            raise InvalidValue(f"{printable(self.path)} cannot be read: {error}",
                               "Copy it back from a backup.") from None
        self.key, self.robots, self.removed, self._read_at = key, robots, removed, at

    def save(self, robots: List[Entry], removed: Optional[Dict[str, int]] = None) -> None:
        """Replace the robots, in the file too. Raises OSError."""
        self._write(self.path, {"key": self.key, "robots": [each._asdict() for each in robots],
                                "removed": self.removed if removed is None else removed})
        self._read_at = None

    def remember(self, robot: str, address: str) -> None:
        """A robot has proven its name at this address, HOST:PORT: the next hub finds it there, too."""
        with contextlib.suppress(InvalidValue):
            self.update()  # somebody may have added robots
        entries = {each.name: each for each in self.robots}
        entry = entries.get(robot, Entry(robot, address))
        entries[robot] = entry._replace(last="" if address == entry.authority else address)
        if list(entries.values()) != self.robots:
            with contextlib.suppress(OSError):  # a full disk: this hub knows it anyway
                self.save(list(entries.values()))

    def read(self, name: str, kind: type) -> Any:
        """Return what is kept by this name, or an empty one."""
        try:
            content = json.loads(files.read(self._kept(name)))
        except (OSError, ValueError):
            content = None
        return content if isinstance(content, kind) else kind()

    def keep(self, name: str, content: Any) -> None:
        """Keep this, for this user alone."""
        with contextlib.suppress(OSError):  # a full disk: it ends with this hub
            self._write(self._kept(name), content)

    def _kept(self, name):
        return self.path.with_name(f"hub_{name}.json")

    def _write(self, path, content):
        path.parent.mkdir(OWNER_ONLY, parents=True, exist_ok=True)
        files.replace_secret(path, json.dumps(content, indent=2).encode())
