"""Every message between a page and the cockpit, in one table.

The cockpit checks by it what comes and what goes, docs/protocol.md shows it, and www/messages.d.ts is written from it.
"""

import math
from typing import Any, Callable, Dict, NamedTuple, Optional

from jetbot.kinds import is_number
from jetbot.kinematics import FULL_SPEED, WHEEL_SEPARATION
from jetbot.text import is_printable
from jetbot_ros.contract import MAX_NAME

from ..classroom import program
from .collection import LABELS
from .history import MAX_POINTS, STEP

MAX_TASK = 60       # characters of a task's name
MAX_MESSAGE = 1000  # bytes of a message of the page
MAX_RATE = 40       # messages per second of a page,
MAX_BURST = 50      # and at once: what a pause of the network has held back

LIMITS = {  # what the page and the cockpit must agree about; "hello" brings it
    "name": MAX_NAME, "program_name": program.MAX_NAME, "program": program.MAX_TEXT, "message": MAX_MESSAGE,
    "rate": MAX_RATE, "burst": MAX_BURST, "trail": MAX_POINTS, "trail_step": STEP,
    "wheel_separation": WHEEL_SEPARATION, "full_speed": FULL_SPEED}


class Field(NamedTuple):
    """What a field may hold. type: in TypeScript; accepts: whether it may be this value; range: for people, or ""."""

    type: str
    accepts: Callable[[Any], bool]
    range: str = ""


class Form(NamedTuple):
    """A message: its fields, what it means, and whether only a teacher may send it."""

    fields: Dict[str, Field]
    meaning: str
    teacher: bool = False


def text(limit: int) -> Field:
    """Return the field of a text that a person may see, of so many characters at most."""
    return Field("string", lambda value: is_printable(value, limit), f"{limit} characters")


def one_of(*texts: str) -> Field:
    """Return the field of one of these texts."""
    return Field(" | ".join(f'"{each}"' for each in texts), lambda value: isinstance(value, str) and value in texts)


def or_null(field: Field) -> Field:
    """Return the field that may also be null, or left out."""
    return field._replace(type=f"{field.type} | null", accepts=lambda value: value is None or field.accepts(value))


def list_of(field: Field, limit: float = math.inf) -> Field:
    """Return the field of a list, of so many values at most."""
    return Field(f"{field.type}[]", lambda value: isinstance(value, (list, tuple)) and len(value) <= limit
                 and all(map(field.accepts, value)), f"{limit} at most" if limit < math.inf else "")


def numbers(count: int) -> Field:
    """Return the field of a list of so many numbers."""
    return Field(f"[{', '.join(['number'] * count)}]",
                 lambda value: isinstance(value, (list, tuple)) and len(value) == count and all(map(is_number, value)))


def part(name: str, /, **fields: Field) -> Field:
    """Return the field of an object with exactly these fields; PARTS lists it."""
    PARTS[name] = fields
    return Field(name, lambda value: isinstance(value, dict) and value.keys() == fields.keys() and fit(value, fields))


def by_name(field: Field) -> Field:
    """Return the field of an object with a value for each name."""
    return Field(f"Record<string, {field.type}>",
                 lambda value: isinstance(value, dict) and all(map(field.accepts, value.values())))


def fit(fields: Dict[str, Any], row: Dict[str, Field]) -> bool:
    """Return whether these are fields of the row, with what they may hold; one that may be null may be left out."""
    return fields.keys() <= row.keys() and all(field.accepts(fields.get(name)) for name, field in row.items())


PARTS: Dict[str, Dict[str, Field]] = {}
TEXT = Field("string", lambda value: isinstance(value, str))
ROBOT = TEXT  # a namespace; Control knows which there are
ROBOT_OR_ALL = or_null(ROBOT)
NUMBER = Field("number", is_number)
COUNT = Field("number", lambda value: type(value) is int and value >= 0)
BOOLEAN = Field("boolean", lambda value: isinstance(value, bool))
DEFLECTION = Field("number", lambda value: is_number(value) and abs(value) <= 1, "-1 to 1")
TASK = text(MAX_TASK)
ID = Field("string", program.is_id, "16 hexadecimal digits")
VERSION = Field("number", program.is_version)
PROGRAM_NAME = Field("string", program.is_program_name, f"{program.MAX_NAME} characters")
POSE = numbers(3)
ARGUMENTS = by_name(TEXT)
TEXT_OR_SAID = Field("string | Said", lambda value: TEXT.accepts(value) or NOTICE.accepts(value))
SAID = {"code": TEXT, "arguments": by_name(TEXT_OR_SAID), "text": TEXT, "template": TEXT}  # a Notice
NOTICE = part("Said", **SAID)
SENTENCES = list_of(part("Sentence", code=TEXT, template=TEXT, arguments=ARGUMENTS))
HEALTH = part("Health", code=TEXT, template=TEXT, arguments=ARGUMENTS, level=one_of("ok", "warning", "bad"))
DRIVER = part("Driver", id=COUNT, name=TEXT, said=or_null(NOTICE))
JUDGED = part("JudgedTask", name=TEXT, title=TEXT, state=one_of("ready", "driving", "done", "cancelled"), text=TEXT,
              seconds=or_null(NUMBER), score=or_null(NUMBER), driver=TEXT, request=TEXT, sentences=SENTENCES,
              lost=or_null(NUMBER))
PICTURES = part("Pictures", **dict.fromkeys(LABELS, COUNT), problem=or_null(NOTICE))
ROBOT_STATE = part(
    "RobotState", status=TEXT, state=one_of("", "driving", "stopped", "ended"), cause=TEXT, template=TEXT,
    arguments=ARGUMENTS, remarks=or_null(SENTENCES), health=or_null(list_of(HEALTH)), holds=list_of(TEXT),
    waiting=list_of(TEXT), fake=BOOLEAN, warning=BOOLEAN, answers=BOOLEAN, stopped=BOOLEAN, pose=or_null(POSE),
    speed=or_null(numbers(2)), command=or_null(numbers(2)), wheels=or_null(numbers(2)), program=TEXT,
    driver=or_null(DRIVER), resumes=or_null(COUNT), held=or_null(one_of("robot", "programs")), stalls=COUNT,
    task=or_null(JUDGED), pictures=or_null(PICTURES), programs=COUNT, link=or_null(NUMBER))
ROBOT_ROW = part("Robot", id=ROBOT, label=TEXT, color=TEXT, workshop=or_null(BOOLEAN), wheel_separation=NUMBER,
                 max_speed=NUMBER, simulated=BOOLEAN, pupil=TEXT, version=TEXT, address=TEXT)
ODOM, WHEELS, LINE, BATTERY = (list_of(numbers(count)) for count in (6, 5, 4, 2))  # each row begins with its stamp
SHAPE = part("Shape", kind=one_of("wall", "line", "course", "goal"), width=NUMBER, points=list_of(numbers(2)))
SCORE = part("Score", task=TEXT, robot=TEXT, score=NUMBER, seconds=or_null(NUMBER), name=TEXT)
OFFERED = part("Task", name=TEXT, title=TEXT, on=BOOLEAN)
CODE = part("Code", label=TEXT, role=TEXT, robot=or_null(ROBOT), url=TEXT, code=TEXT, rows=list_of(TEXT))
AGREED = part("Limits", **dict.fromkeys(LIMITS, NUMBER))

FROM_PAGE = {
    "drive": Form({"robot": ROBOT, "forward": DEFLECTION, "left": DEFLECTION},
                  "deflections, forward and to the left, 20 times a second; both 0: let go"),
    "program": Form({"robot": ROBOT}, "a program runs: keeps a free robot while it stands; is answered by `program`"),
    "take": Form({"robot": ROBOT}, "takes the robot from whoever drives it, until `go_on`", teacher=True),
    "go_on": Form({"robot": ROBOT_OR_ALL}, "gives the robot back, or all: ends what `take` or a teacher's `stop` holds",
                  teacher=True),
    "stop": Form({"robot": ROBOT_OR_ALL}, "emergency stop: of all robots, or of this one"),
    "release": Form({"robot": ROBOT_OR_ALL}, "ends that stop"),
    "reset": Form({"robot": ROBOT_OR_ALL}, "puts all simulated robots back to their starts, or this one; "
                  "ends the pads, programs of blocks and tasks there", teacher=True),
    "name": Form({"name": text(MAX_NAME)}, "what the person is called"),
    "pupil": Form({"robot": ROBOT, "name": text(MAX_NAME)},
                  'what the pupil of this robot is called, whatever the pupil types; `""`: nothing', teacher=True),
    "ping": Form({"sent": NUMBER}, "is answered by `pong` with the same number"),
    "look": Form({"robot": ROBOT_OR_ALL}, "shows what this robot's camera sees, and no other's any more; null: none"),
    "seen": Form({"number": NUMBER}, "a part of the picture with this number has come; the next one may follow"),
    "curves": Form({"robot": ROBOT_OR_ALL, "eyes": BOOLEAN},
                   "asks for what this robot reports, for curves, and for no other's any more; null: none; `eyes`: its "
                   "`line`, too"),
    "save": Form({"robot": ROBOT, "label": one_of(*LABELS)}, "keeps the robot's newest picture; from its driver"),
    "delete": Form({"robot": ROBOT}, "deletes the pictures of this robot that were kept; from its driver"),
    "codes": Form({}, "asks for the addresses and codes to hand out", teacher=True),
    "new_code": Form({"robot": ROBOT_OR_ALL},
                     "replaces the code for this robot, or for all pupils, and disconnects who came in with the old "
                     "one; is answered by `codes`", teacher=True),
    "judge": Form({"robot": ROBOT, "task": TASK},
                  'puts a simulated robot at the start of a task, and judges its next drive; task `""`: ends that, '
                  "without a score"),
    "offer": Form({"task": TASK, "on": BOOLEAN}, "lets pupils choose a task, or not any more", teacher=True),
    "cameras": Form({"on": BOOLEAN}, "lets pupils see what the cameras see, or not any more", teacher=True),
}

FROM_COCKPIT = {
    "hello": Form({"id": COUNT, "name": TEXT, "role": one_of("pupil", "teacher"), "robot": or_null(ROBOT),
                   "codes": BOOLEAN, "limits": AGREED},
                  "who you are; `robot`: the only one that you may drive, or null; `codes`: whether you may see codes; "
                  "`limits`: what the cockpit and its pages agree about"),
    "robots": Form({"robots": list_of(ROBOT_ROW)}, "which robots there are: at first, and when that changes"),
    "state": Form({"emergency": BOOLEAN, "pupils_release": BOOLEAN, "unconfirmed": list_of(ROBOT),
                   "robots": by_name(ROBOT_STATE)},
                  "what each one does: at most 12.5 times a second, at least once"),
    "trail": Form({"robot": ROBOT, "start": or_null(POSE), "points": list_of(numbers(2), MAX_POINTS)},
                  "where it started, and has been since: at first, and empty when it was put back"),
    "scene": Form({"robot": ROBOT, "shapes": list_of(SHAPE)},
                  "what is drawn around a robot: at first, and when that changes"),
    "scores": Form({"scores": list_of(SCORE)}, "the class's best: at first, and when it changes"),
    "picture": Form({"robot": ROBOT, "number": COUNT, "stamp": NUMBER, "bytes": COUNT},
                    "a picture of the robot that the page looks at; its parts follow"),
    "curves": Form({"robot": ROBOT, "now": NUMBER, "after": COUNT, "number": COUNT, "odom": ODOM,
                    "wheels": WHEELS, "line": LINE, "battery": BATTERY},
                   "what a robot has reported: rows of a stamp, and of values as they were published"),
    "tasks": Form({"tasks": list_of(OFFERED)},
                  "which tasks a judge offers, and which of them are on: at first, and when that changes"),
    "cameras": Form({"on": BOOLEAN}, "whether pupils see what the cameras see: at first, and when that changes"),
    "notice": Form(SAID, "one sentence for the person, and its code for programs"),
    "program": Form({"robot": ROBOT, "ready": BOOLEAN, "pose": or_null(POSE), "speed": or_null(numbers(2)),
                     "line": or_null(numbers(3)), "command": or_null(numbers(2)), "wheels": or_null(numbers(2))},
                    "the answer to `program`; `ready`: whether its controller is connected"),
    "lift": Form({"robot": ROBOT, **SAID},
                  "why a `drive` or `program` was refused, or a `reset` ended it, and the robot stopped; the next one "
                  "counts after letting go"),
    "judge": Form({"robot": ROBOT, "request": TEXT, "refusal": or_null(NOTICE)},
                  "the answer to `judge`: the `request` of the robot's `task` from then on, or why it is refused"),
    "pong": Form({"sent": NUMBER}, "the answer to `ping`"),
    "codes": Form({"codes": list_of(CODE)},
                  "the answer to `codes` and `new_code`; `rows` are the modules of the QR code"),
}

REQUESTS = {  # to /work, by what they "do"
    "list": Form({"robot": ROBOT_OR_ALL}, "`programs`, those first that were changed last; of all robots: teacher"),
    "open": Form({"robot": ROBOT, "id": ID, "version": or_null(VERSION)},
                "the program, with the `program` of this version; without `version`, of the newest"),
    "save": Form({"robot": ROBOT, "id": ID, "version": VERSION, "name": PROGRAM_NAME, "program": TEXT,
                 "class": or_null(ID)}, "what is kept now"),
    "delete": Form({"robot": ROBOT, "id": ID}, "the same"),
    "restore": Form({"robot": ROBOT, "id": ID}, "the same: undoes `delete`"),
}


def problem_of(message: Dict[str, Any]) -> Optional[str]:
    """Return what is wrong with a message of the cockpit by the table, or None."""
    fields = dict(message)
    kind = fields.pop("type")
    row = FROM_COCKPIT[kind].fields if kind in FROM_COCKPIT else None
    if row is None or fields.keys() != row.keys():
        return f"{kind} has the fields {', '.join(fields)}"
    wrong = [name for name, field in row.items() if not field.accepts(fields[name])]
    return f"{kind}.{wrong[0]} is not {row[wrong[0]].type}" if wrong else None
