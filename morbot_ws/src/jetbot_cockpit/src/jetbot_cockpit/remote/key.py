"""The keys of a class and of its robots, and how a robot and a hub prove that they have one without sending it.

A class's key is on the teacher's computer alone. A robot's own key is made from it and the robot's name, so that no
robot passes as another, whatever it says. Each connection has a nonce of either side: a recording is worth nothing. The
proofs cover the address that the hub has dialled: who passes the messages of a robot on has another.
"""

import base64
import contextlib
import hashlib
import hmac
import json
import re
import secrets
from typing import Any, Dict, Optional

ROBOT_NAME = re.compile(r"[A-Za-z][A-Za-z0-9_]{0,29}")
LENGTH = 26         # characters of a key: 130 bits
NONCE = re.compile(r"[0-9a-f]{32}")
HUB, ROBOT = "hub", "robot"  # who proves
PROTOCOL = "morbot 2"  # a hub and a robot of different ones refuse each other
WRONG_KEY, RELAYED = 4005, 4006  # why a robot closes a hub's socket


def new_nonce() -> str:
    """Return 128 random bits."""
    return secrets.token_hex(16)


def new_key() -> str:
    """Return the key of a new class."""
    return as_key(secrets.token_bytes(32))


def robot_key(class_key: str, robot: str) -> str:
    """Return the key of a robot of the class."""
    return as_key(hmac.digest(class_key.encode(), robot.encode(), hashlib.sha256))


def as_key(digest: bytes) -> str:
    """Return letters and digits that a person can type."""
    return base64.b32encode(digest).decode()[:LENGTH]


def read_key(typed: str) -> Optional[str]:
    """Return the key that a person has typed, in whatever groups, or None if it cannot be one."""
    key = re.sub(r"[\s-]", "", typed).upper()
    return key if re.fullmatch(f"[A-Z2-7]{{{LENGTH}}}", key) else None


def proof(key: str, side: str, challenge: Dict[str, Any], answer: Dict[str, Any]) -> str:
    """Return what only who has the robot's key can say on this connection. side: HUB or ROBOT, who says it.

    It covers all fields of both messages, but the answer's own proof: nobody changes them on the way.
    """
    said = {name: value for name, value in answer.items() if name != "proof"}
    text = json.dumps([PROTOCOL, side, challenge, said], sort_keys=True)
    return hmac.new(key.encode(), text.encode(), hashlib.sha256).hexdigest()


def proves(said: object, *expected: Any) -> bool:
    """Return whether this is the proof of what is expected, as of ``proof``."""
    with contextlib.suppress(RecursionError):  # a list in a list, and so on
        return isinstance(said, str) and hmac.compare_digest(said.encode(errors="replace"), proof(*expected).encode())
    return False
