"""The messages of the cockpit's socket: JSON objects with a ``type``. docs/cockpit.md lists them."""

import json
import math
from typing import Any, Dict, NamedTuple, Optional

MAX_MESSAGE = 1000      # bytes of a message of the page
MAX_RATE = 40           # messages per second of a page
DRIVE_RATE = 20         # Hz at which the page repeats what its pad commands
MAX_NAME = 20           # characters of a person's name


class ProtocolError(Exception):
    """A message is not of the documented form; the socket is closed with this reason."""


class Drive(NamedTuple):
    """Deflections in [-1, 1]: forward, and to the left. Both 0: the pad was released."""

    robot: str
    forward: float
    left: float


class Take(NamedTuple):
    """A teacher takes the robot from whoever drives it."""

    robot: str


class Stop(NamedTuple):
    """Emergency stop of all robots, or of one."""

    robot: Optional[str] = None


class Release(NamedTuple):
    """End of that stop."""

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


Message = NamedTuple  # one of the classes above


def is_deflection(value: Any) -> bool:
    return is_number(value) and abs(value) <= 1


def is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool) and math.isfinite(value)


def is_text(value: Any) -> bool:
    return isinstance(value, str)


def is_name(value: Any) -> bool:
    return is_text(value) and len(value) <= MAX_NAME and value.isprintable()


def is_text_or_none(value: Any) -> bool:
    return value is None or is_text(value)


# type: (class, {field: check}); a field whose class has a default may be left out
MESSAGES: Dict[str, tuple] = {
    "drive": (Drive, {"robot": is_text, "forward": is_deflection, "left": is_deflection}),
    "take": (Take, {"robot": is_text}),
    "stop": (Stop, {"robot": is_text_or_none}),
    "release": (Release, {"robot": is_text_or_none}),
    "reset": (Reset, {"robot": is_text_or_none}),
    "name": (Name, {"name": is_name}),
    "ping": (Ping, {"sent": is_number}),
    "codes": (Codes, {}),
}


def parse(text: str) -> Message:
    """Return the message; raise ProtocolError for one that is not of the documented form."""
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        raise ProtocolError("a message is a JSON object") from None
    if not isinstance(fields, dict) or fields.get("type") not in list(MESSAGES):
        raise ProtocolError(f"a message is a JSON object with a type: {', '.join(MESSAGES)}")
    kind = fields.pop("type")
    message, checks = MESSAGES[kind]
    missing = set(checks) - set(fields) - set(message._field_defaults)
    if missing or not all(name in checks and checks[name](value) for name, value in fields.items()):
        raise ProtocolError(f"the fields of {kind} are: {', '.join(checks) or 'none'}")
    return message(**fields)
