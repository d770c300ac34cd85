"""The messages of the cockpit's socket: JSON objects with a ``type``."""

import json
import logging
from typing import NamedTuple, Optional, Union

from ..notices import Notice
from .messages import FROM_PAGE, MAX_MESSAGE, fit, problem_of

INVALID, LOG_IN, FULL, FLOODED, SILENT, ENDED = 4000, 4001, 4002, 4003, 4004, 1001  # why a socket is closed
NO_CODE = "log in first"
MAX_FRAME = 8192         # bytes of a message that is read at all; Tornado closes the socket of a larger one with 1009
FRAME_INTERVAL = 0.08    # s between two frames: what the pages draw more often delays a stop
PICTURE_INTERVAL = 0.01  # s between two looks at the cameras, while somebody looks


class ProtocolError(Exception):
    """A message is not of the documented form; the socket is closed with this reason."""


class Message(NamedTuple):
    """What a page sends. What its type does not have, or what was left out, has the default.

    robot: a namespace, None: all robots; forward, left: deflections in [-1, 1], both 0: the pad was let go;
    name: what a person is called; sent: a number that is sent back at once; number: of a picture; label:
    what a picture shows, one of LABELS; task: its name; on: whether pupils may choose it, or see what
    the cameras see; eyes: whether curves show the line sensor.
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
    eyes: bool = False

    @property
    def moves(self) -> bool:
        """Whether it drives a robot."""
        return bool(self.forward or self.left)


def as_stop(text: Union[str, bytes]) -> Optional[Message]:
    """Return the message if it is a stop, however it is spelled, else None. It needs less than ``parse``."""
    try:
        fields = json.loads(text) if isinstance(text, str) and len(text) <= MAX_MESSAGE else None
    except (ValueError, RecursionError):
        return None
    if not isinstance(fields, dict) or fields.pop("type", None) != "stop":
        return None
    robot = fields.pop("robot", None)
    return Message("stop", robot) if not fields and isinstance(robot, (str, type(None))) else None


def parse(text: Union[str, bytes]) -> Message:
    """Return the message; raise ProtocolError for one that is not of the documented form."""
    if not isinstance(text, str) or len(text.encode(errors="replace")) > MAX_MESSAGE:
        raise ProtocolError(f"a message is text, of {MAX_MESSAGE} bytes at most")
    try:
        fields = json.loads(text)
    except (ValueError, RecursionError):
        fields = None
    kind = fields.pop("type", None) if isinstance(fields, dict) else None
    if kind not in list(FROM_PAGE):  # a list: what is not hashable may be there
        raise ProtocolError("a message is a JSON object of a type that docs/protocol.md lists")
    row = FROM_PAGE[kind].fields
    if not fit(fields, row):
        raise ProtocolError(f"the fields of {kind} are: {', '.join(row) or 'none'}")
    return Message(kind, **fields)


def notice(content: Notice) -> dict:
    """Return a message of the cockpit: one sentence for the person."""
    return {"type": "notice", **content.fields()}


def dumps(message: dict) -> str:
    """Return a message as it is sent; one that is not as documented is logged, for a page can do without a field."""
    problem = problem_of(message)
    if problem:
        logging.getLogger(__name__).error("A message is not as documented: %s", problem)
    return json.dumps(message, separators=(",", ":"))
