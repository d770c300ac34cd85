"""The programs of the robots, made of blocks on the page: each one a JSON text, and a file of the class."""

import json
import re
from typing import Any, Dict, FrozenSet, Iterator, List, NamedTuple, Optional

from jetbot.text import is_printable

from ..notices import Notice, say

PREFIX = "program_"
ID = re.compile(r"[0-9a-f]{16}")
TOKENS = re.compile(r'"(?:[^"\\]|\\.)*"?|[{}\[\]]|[^{}\[\]"]+', re.DOTALL)  # texts, brackets, what is between them
JSON = json.JSONDecoder(parse_int=str, parse_float=str)  # numbers stay text: a long one would take long
MAX_NAME = 40              # characters
MAX_TEXT = 64 * 1024       # bytes of a program
MAX_PROGRAMS = 50          # of a robot, those that were deleted last included,
MAX_TOTAL = 1024 * 1024    # and bytes of all of them


class Refused(Exception):
    """Why a program is not kept or shown: a Notice."""

    def __init__(self, notice: Notice):
        super().__init__(notice)
        self.notice = notice


class Program(NamedTuple):
    """A program of a robot. version: grows with each change; changed: the order of the changes to all programs."""

    id: str
    robot: str
    name: str
    version: int
    changed: int
    deleted: bool
    program: str

    def row(self, contested: bool = False) -> dict:
        """Return it as in a list: without its text. contested: whether another page's change of it was refused."""
        row = {name: value for name, value in self._asdict().items() if name not in ("program", "changed")}
        return {**row, "contested": contested}


class Programs:
    """All programs, which one thread may change, and others read. folder: a ClassFolder, or Nowhere."""

    def __init__(self, folder):
        self._folder = folder
        self._programs: Dict[str, Program] = {each.id: each for each in read_all(folder)}  # replaced, never changed
        self._latest: Dict[str, int] = {}
        self._contested: FrozenSet[str] = frozenset()
        for each in self._programs.values():
            self._latest[each.robot] = max(each.changed, self._latest.get(each.robot, 0))

    def changed(self, robot: str) -> int:
        """Return a number that grows with each change to the robot's programs; 0 without one."""
        return self._latest.get(robot, 0)

    def rows(self, robot: Optional[str]) -> List[dict]:
        """Return the programs of a robot, or of all (None), those first that were changed last."""
        programs = sorted(self._of(robot), key=lambda each: -each.changed)
        return [each.row(each.id in self._contested) for each in programs]

    def open(self, robot: str, id: str) -> Program:
        """Return a program of the robot. Raise Refused."""
        found = self._programs.get(id)
        if not found or found.robot != robot:
            raise Refused(say("gone"))
        return found

    def save(self, robot: str, id: str, version: int, name: str, program: str) -> Program:
        """Keep a program; return it with its new version. Raise Refused, OSError.

        version: the one that was changed, 0 for a new program. The same again is answered again: the first answer was
        lost. A program that is not known is kept as well: the cockpit was started again.
        """
        before = self._programs.get(id)
        if before and before.robot != robot:
            raise Refused(say("gone"))
        if before and (before.name, before.program, before.deleted) == (name, program, False):
            return before
        if before and before.version != version:
            self._contested |= {id}
            self._latest = {**self._latest, robot: self._next()}  # so that the other page looks
            raise Refused(say("conflict"))
        problem = problem_of(program)
        if problem:
            raise Refused(problem)
        version = before.version + 1 if before else 1
        new = Program(id, robot, name, version, self._next(), False, program)
        return self._keep(new, self._leaving(new))

    def delete(self, robot: str, id: str, version: int, deleted: bool) -> Program:
        """Delete a program, or undo that; return it with its new version. Raise Refused, OSError."""
        before = self.open(robot, id)
        if before.deleted == deleted:
            return before
        if before.version != version:
            raise Refused(say("conflict"))
        return self._keep(before._replace(version=version + 1, changed=self._next(), deleted=deleted))

    def _keep(self, program, leaving=()):
        """Write before it counts; what makes room for it goes last, so that a kill at any moment loses nothing."""
        self._folder.write(PREFIX + program.id, program._asdict())
        self._programs = {**self._programs, program.id: program}
        self._latest = {**self._latest, program.robot: program.changed}
        self._contested -= {program.id}
        for each in leaving:
            self._folder.remove(PREFIX + each.id)
            self._programs = {id: other for id, other in self._programs.items() if id != each.id}
        return program

    def _leaving(self, new):
        """Return the deleted programs that make room for a new one, the oldest first. Raise Refused."""
        others = [each for each in self._of(new.robot) if each.id != new.id]
        count, total = len(others) + 1, sum(len(each.program.encode()) for each in [*others, new])
        leaving = []
        for each in sorted(others, key=lambda each: (not each.deleted, each.changed)):
            if count <= MAX_PROGRAMS and total <= MAX_TOTAL:
                break
            if not each.deleted:
                raise Refused(say("full", count=MAX_PROGRAMS))
            leaving.append(each)
            count, total = count - 1, total - len(each.program.encode())
        return leaving

    def _of(self, robot):
        return [each for each in self._programs.values() if robot in (None, each.robot)]

    def _next(self):
        return 1 + max(self._latest.values(), default=0)


def is_id(value: Any) -> bool:
    """Return whether this may be the id of a program."""
    return isinstance(value, str) and bool(ID.fullmatch(value))


def is_version(value: Any) -> bool:
    """Return whether this may be the version of a program."""
    return type(value) is int and 0 <= value < 1 << 31


def is_program_name(value: Any) -> bool:
    """Return whether a program may be called this."""
    return is_printable(value, MAX_NAME) and value.strip() != ""


def problem_of(program: str) -> Optional[Notice]:
    """Return why this text is not kept as a program, or None; the page checks what it opens."""
    try:
        if len(program.encode()) > MAX_TEXT:
            return say("too_large", kilobytes=MAX_TEXT // 1024)
        return None if is_object(program) else say("no_program")
    except ValueError:
        return say("no_program")


def is_object(text: str) -> bool:
    """Return whether this is a JSON object, or raise ValueError for what is no JSON.

    A chain of blocks is nested, since each one holds the next: deeper than Python reads JSON. So each object and list
    is read by itself, from the inmost on, with a null for what it holds.
    """
    parts = [""]  # of each object and list that is open, what has come so far
    for token in TOKENS.findall(text):
        if token in "{[":
            parts.append("")
        parts[-1] += token
        if token in "}]":
            JSON.decode(parts.pop())
            parts[-1] += " null "
    return text.lstrip().startswith("{") and len(parts) == 1 and JSON.decode(parts[0]) is None


def read_all(folder) -> Iterator[Program]:
    """Yield the programs of a class; a file that holds none is put aside."""
    for name in folder.names(PREFIX):
        content = folder.read(name)
        if is_program(content) and name == PREFIX + content["id"]:
            yield Program(**content)
        elif content is not None:
            folder.set_aside(name)


def is_program(content: Any) -> bool:
    """Return whether this is a Program's content."""
    if not isinstance(content, dict) or set(content) != set(Program._fields):
        return False
    return (is_id(content["id"]) and isinstance(content["robot"], str) and is_program_name(content["name"])
            and is_version(content["version"]) and is_version(content["changed"])
            and isinstance(content["deleted"], bool) and isinstance(content["program"], str)
            and not problem_of(content["program"]))
