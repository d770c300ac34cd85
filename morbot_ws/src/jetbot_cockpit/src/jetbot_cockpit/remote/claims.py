"""What a hub believes a robot: what it says of itself. A stolen one proves its own name, and may lie about all else."""

from typing import Any, Dict, List, Optional

from jetbot.sentence import MAX_TEXT, read_row
from jetbot.text import is_printable, printable
from jetbot_ros.contract import MAX_NAME

from ..classroom import program
from ..notices import NOTICES, Notice, say
from ..session.messages import NOTICE
from ..session.rights import PUPIL
from ..web.access import ALPHABET, CODE_LENGTH, Grant
from ..web.handout import Card

REFUSALS = 409, 503, 507  # with a Notice, of a request to /work


def is_own(robot: str, message: Dict[str, Any]) -> bool:
    """Return whether a message of FROM_COCKPIT is about no other robot."""
    rows = message["scores"] if message["type"] == "scores" else ()
    return message.get("robot") in (None, f"/{robot}") and all(
        row["robot"] == robot and is_printable(row["name"], MAX_NAME) for row in rows)


def attributed(robot: str, message: Dict[str, Any]) -> Dict[str, Any]:
    """Return a message with a Notice as this hub words it; it names the robot."""
    known = understood(message)
    if not known or known.arguments.get("robot") != robot:
        sentence = known or printable(message["text"][:MAX_TEXT])
        known = say("from_robot", robot=robot, sentence=sentence)._replace(code=message["code"])
    return {**message, **known.fields()}


def understood(said: Dict[str, Any]) -> Optional[Notice]:
    """Return the Notice that a robot has said, by its code; None for one that is not of this version."""
    arguments = {name: understood(value) if isinstance(value, dict) else value
                 for name, value in said["arguments"].items()}
    are_words = all(isinstance(value, Notice) or is_printable(value, MAX_TEXT) for value in arguments.values())
    return read_row(NOTICES, said["code"], arguments) if are_words else None


def cards(robot: str, rows: List[Dict[str, Any]], host: str, port: int) -> List[Dict[str, object]]:
    """Return the rows of the message "codes" for the robot's pupils, whose addresses lead to it."""
    grants = [Grant(robot, PUPIL, f"/{robot}", row["code"], "") for row in rows
              if (row["role"], row["robot"]) == (PUPIL, f"/{robot}") and is_code(row["code"])]
    return [Card(grant, host, port).message() for grant in grants]


def is_code(text: str) -> bool:
    """Return whether this can be a pupil's code."""
    return len(text) == CODE_LENGTH[PUPIL] and set(text) <= set(ALPHABET)


def is_answer(robot: str, status: Any, body: Any) -> bool:
    """Return whether a robot may answer this to a request to /work."""
    if status == 200 and isinstance(body, dict):
        rows = body["programs"] if "programs" in body else [body]
        return isinstance(rows, list) and all(is_program(robot, row) for row in rows)
    return status in REFUSALS and NOTICE.accepts(body)


def is_program(robot: str, row: Any) -> bool:
    """Return whether this is a program of the robot, as of classroom.programs."""
    return (isinstance(row, dict) and row.get("robot") == f"/{robot}" and program.is_id(row.get("id"))
            and program.is_version(row.get("version")) and program.is_program_name(row.get("name"))
            and isinstance(row.get("deleted"), bool) and isinstance(row.get("program", ""), str)
            and isinstance(row.get("earlier"), list) and all(map(is_earlier, row["earlier"])))


def is_earlier(row: Any) -> bool:
    """Return whether this is a version of a program."""
    return (isinstance(row, dict) and program.is_version(row.get("version"))
            and program.is_program_name(row.get("name")))
