"""What ./morbot robot remembers of a computer, so that it can change the service and undo all."""

import contextlib
import fcntl
import json
import os
from pathlib import Path
from typing import Dict, Iterator, NamedTuple, Tuple

from jetbot import files

from .computer import refuse

FILE = "~/.local/share/morbot/robot.json"


class Memory(NamedTuple):
    """arguments: of the launch file; host: its name before; groups: those that the user was put into."""

    arguments: Dict[str, str] = {}
    host: str = ""
    groups: Tuple[str, ...] = ()

    def save(self) -> None:
        """Replace the file. Raise OSError."""
        path = Path(FILE).expanduser()
        path.parent.mkdir(parents=True, exist_ok=True)
        files.replace(path, json.dumps(self._asdict()).encode())


def load() -> Memory:
    """Return what the file says. Raise Refused if it is damaged."""
    path = Path(FILE).expanduser()
    if not path.exists():
        return Memory()
    try:
        memory = Memory(**json.loads(files.read(path)))
        if not (isinstance(memory.arguments, dict) and isinstance(memory.host, str)
                and all(isinstance(each, str) for each in [*memory.arguments.values(), *memory.groups])):
            raise ValueError
    except (OSError, ValueError, TypeError):
        refuse(f"{path} is damaged", "Delete it, and name the robot again.")
    return memory._replace(groups=tuple(memory.groups))


@contextlib.contextmanager
def alone() -> Iterator[None]:
    """Keep other ./morbot robot away meanwhile. Raise Refused if one is at work."""
    descriptor = os.open(Path.home(), os.O_RDONLY)
    try:
        fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        yield
    except BlockingIOError:
        refuse("another ./morbot robot is at work on this computer", "Wait until it has ended.")
    finally:
        os.close(descriptor)


def forget() -> None:
    """Delete the file. Raise OSError."""
    Path(FILE).expanduser().unlink(missing_ok=True)
