"""The messages of the cockpit's socket: JSON objects with a ``type``. docs/protocol.md lists them."""

import json
import unicodedata
from typing import Any, Dict, NamedTuple, Optional, Union

from jetbot.kinds import is_number

MAX_MESSAGE = 1000      # bytes of a message of the page
MAX_RATE = 40           # messages per second of a page,
MAX_BURST = 50          # and at once: what a pause of the network has held back
MAX_NAME = 20           # characters of a person's name


class ProtocolError(Exception):
    """A message is not of the documented form; the socket is closed with this reason."""


class Drive(NamedTuple):
    """Deflections in [-1, 1]: forward, and to the left. Both 0: the pad was let go."""

    robot: str
    forward: float
    left: float


class Take(NamedTuple):
    """A teacher takes the robot from whoever drives it."""

    robot: str


class EngageStop(NamedTuple):
    """Engages the emergency stop of all robots, or of one."""

    robot: Optional[str] = None


class ReleaseStop(NamedTuple):
    """Ends that stop."""

    robot: Optional[str] = None


class Reset(NamedTuple):
    """A teacher puts all simulated robots back to their starts, or one."""

    robot: Optional[str] = None


class Name(NamedTuple):
    """What the person wants to be called."""

    name: str


class Ping(NamedTuple):
    """Is answered at once, with the same number, so that the page can measure the round trip."""

    sent: float


class Codes(NamedTuple):
    """A teacher asks for the addresses and codes to hand out."""


Message = Union[Drive, Take, EngageStop, ReleaseStop, Reset, Name, Ping, Codes]


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
    """Return whether this is a person's name; browsers know newer characters than this Python, such as emoji."""
    return isinstance(value, str) and len(value) <= MAX_NAME and all(
        character.isprintable() or unicodedata.category(character) == "Cn" for character in value)


# type: (class, {field: check}); a field whose class has a default may be left out
MESSAGES: Dict[str, tuple] = {
    "drive": (Drive, {"robot": is_robot, "forward": is_deflection, "left": is_deflection}),
    "take": (Take, {"robot": is_robot}),
    "stop": (EngageStop, {"robot": is_robot_or_all}),
    "release": (ReleaseStop, {"robot": is_robot_or_all}),
    "reset": (Reset, {"robot": is_robot_or_all}),
    "name": (Name, {"name": is_name}),
    "ping": (Ping, {"sent": is_number}),
    "codes": (Codes, {}),
}


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
        raise ProtocolError(f"a message is a JSON object with a type: {', '.join(MESSAGES)}")
    message, checks = MESSAGES[kind]
    missing = set(checks) - set(fields) - set(message._field_defaults)
    if missing or not all(name in checks and checks[name](value) for name, value in fields.items()):
        raise ProtocolError(f"the fields of {kind} are: {', '.join(checks) or 'none'}")
    return message(**fields)


def notice(text: str) -> dict:
    """Return a message of the cockpit: one sentence for the person."""
    return {"type": "notice", "text": text}
