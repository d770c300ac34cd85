"""The messages of the cockpit's socket: JSON objects with a ``type``. docs/protocol.md lists them."""

import json
import re
from typing import Any, Callable, Dict, NamedTuple, Optional, Union

from jetbot.kinds import is_number
from jetbot.text import is_printable

from .collection import LABELS

MAX_MESSAGE = 1000      # bytes of a message of the page
MAX_RATE = 40           # messages per second of a page,
MAX_BURST = 50          # and at once: what a pause of the network has held back
STOP = re.compile(r'\s*\{\s*"type"\s*:\s*"stop"\s*(?:,\s*"robot"\s*:\s*(?:null|"([^"\\]*)")\s*)?\}\s*')
MAX_NAME = 20           # characters of a person's name
MAX_TASK = 60           # characters of a task's name


class ProtocolError(Exception):
    """A message is not of the documented form; the socket is closed with this reason."""


class Message(NamedTuple):
    """What a page sends. What its type does not have, or what was left out, has the default.

    robot: a namespace, None: all robots; forward, left: deflections in [-1, 1], both 0: the pad was let go;
    name: what the person wants to be called; sent: a number that is sent back at once; number: of a picture; label:
    what a picture shows, one of LABELS; task: its name; on: whether pupils may choose it.
    """

    type: str
    robot: Optional[str] = None
    forward: float = 0.0
    left: float = 0.0
    name: str = ""
    sent: float = 0.0
    number: float = 0.0
    label: str = ""
    task: str = ""
    on: bool = False


def is_deflection(value: Any) -> bool:
    """Return whether this is a number in [-1, 1]."""
    return is_number(value) and abs(value) <= 1


def is_robot(value: Any) -> bool:
    """Return whether this may be a robot's namespace; Control knows which there are."""
    return isinstance(value, str)


def is_robot_or_all(value: Any) -> bool:
    """Return whether this may be a robot's namespace, or None for all."""
    return value is None or is_robot(value)


def is_name(value: Any) -> bool:
    """Return whether this may be a person's name."""
    return is_printable(value, MAX_NAME)


def is_task(value: Any) -> bool:
    """Return whether this may be a task's name; Tasks knows which there are."""
    return is_printable(value, MAX_TASK)


def is_boolean(value: Any) -> bool:
    """Return whether this is true or false."""
    return isinstance(value, bool)


def is_label(value: Any) -> bool:
    """Return whether this may be said of a picture."""
    return value in list(LABELS)


# The fields of each type; one that may be None may be left out.
MESSAGES: Dict[str, Dict[str, Callable[[Any], bool]]] = {
    "drive": {"robot": is_robot, "forward": is_deflection, "left": is_deflection},
    "program": {"robot": is_robot},         # a program of the page runs: keep its robot, and say what that senses
    "take": {"robot": is_robot},            # a teacher takes the robot from whoever drives it
    "go_on": {"robot": is_robot_or_all},    # a teacher gives back what a teacher's take or stop keeps waiting
    "stop": {"robot": is_robot_or_all},     # engages the emergency stop of all robots, or of one
    "release": {"robot": is_robot_or_all},  # ends that stop
    "reset": {"robot": is_robot_or_all},    # a teacher puts simulated robots back to their starts
    "name": {"name": is_name},
    "ping": {"sent": is_number},
    "codes": {},                            # a teacher asks for the addresses and codes to hand out
    "look": {"robot": is_robot_or_all},     # the page shows this robot's camera, None: none
    "seen": {"number": is_number},          # a part of this picture has come
    "save": {"robot": is_robot, "label": is_label},
    "delete": {"robot": is_robot},          # all pictures of the robot that were saved
    "judge": {"robot": is_robot, "task": is_task},  # judges its next drive in a task; "": not any more
    "offer": {"task": is_task, "on": is_boolean},   # a teacher lets pupils choose a task, or not any more
}


def fit(fields: Dict[str, Any], checks: Dict[str, Callable[[Any], bool]]) -> bool:
    """Return whether these are fields that have a check, and pass it; one that may be None may be left out."""
    return set(fields) <= set(checks) and all(check(fields.get(name)) for name, check in checks.items())


def as_stop(text: Union[str, bytes]) -> Optional[Message]:
    """Return the message if it is a stop as pages write it, else None. It needs less than ``parse``."""
    found = STOP.fullmatch(text) if isinstance(text, str) else None
    return Message("stop", found[1]) if found else None


def parse(text: Union[str, bytes]) -> Message:
    """Return the message; raise ProtocolError for one that is not of the documented form."""
    if not isinstance(text, str) or len(text.encode(errors="replace")) > MAX_MESSAGE:
        raise ProtocolError(f"a message is text, of {MAX_MESSAGE} bytes at most")
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        fields = None
    kind = fields.pop("type", None) if isinstance(fields, dict) else None
    if kind not in list(MESSAGES):  # a list: what is not hashable may be there
        raise ProtocolError("a message is a JSON object of a type that docs/protocol.md lists")
    checks = MESSAGES[kind]
    if not fit(fields, checks):
        raise ProtocolError(f"the fields of {kind} are: {', '.join(checks) or 'none'}")
    return Message(kind, **fields)


def notice(text: str) -> dict:
    """Return a message of the cockpit: one sentence for the person."""
    return {"type": "notice", "text": text}
