"""One program of a robot, made of blocks on the page: its versions, and what a program must be to be kept."""

import json
import re
from typing import Any, NamedTuple, Optional, Tuple

from jetbot.text import is_printable

from ..notices import Notice, say

ID = re.compile(r"[0-9a-f]{16}")
TOKENS = re.compile(r'"(?:[^"\\]|\\.)*"?|[{}\[\]]|[^{}\[\]"]+', re.DOTALL)  # texts, brackets, what is between them
MAX_NAME = 40              # characters
MAX_TEXT = 64 * 1024       # bytes of a program


class Version(NamedTuple):
    """What a page has saved as a program."""

    version: int
    name: str
    program: str


class Program(NamedTuple):
    """A program of a robot: its newest version, and earlier ones, each from another page that has changed it.

    version: grows with each save; changed: the order of the changes to all programs.
    """

    id: str
    robot: str
    name: str
    version: int
    changed: int
    deleted: bool
    program: str
    earlier: Tuple[Version, ...] = ()  # the newest first

    def versions(self) -> Tuple[Version, ...]:
        """Return all its versions, the newest first."""
        return (Version(self.version, self.name, self.program), *self.earlier)

    def size(self) -> int:
        """Return how many bytes the texts of all versions have."""
        return sum(len(each.program.encode()) for each in self.versions())

    def row(self) -> dict:
        """Return it as in a list: without its texts."""
        return {"id": self.id, "robot": self.robot, "name": self.name, "version": self.version,
                "deleted": self.deleted, "earlier": [{"version": each.version, "name": each.name}
                                                     for each in self.earlier]}

    def opened(self, version: Optional[int] = None) -> dict:
        """Return it as in a list, with the text of one of its versions; of the newest if that one is not kept."""
        newest, *earlier = self.versions()
        return {**self.row(), **next((each for each in earlier if each.version == version), newest)._asdict()}


def refuse(constant: str) -> None:
    """Raise ValueError for NaN or Infinity, which Python reads, but which are no JSON."""
    raise ValueError(f"{constant} is no JSON")


# Numbers stay text: a long one would take long
JSON = json.JSONDecoder(parse_int=str, parse_float=str, parse_constant=refuse)


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


def is_program(content: Any) -> bool:
    """Return whether this is a Program's content; MorBot 1.2 wrote no earlier versions."""
    if not isinstance(content, dict) or {"earlier", *content} != set(Program._fields):
        return False
    earlier = content.get("earlier", [])
    return (is_id(content["id"]) and isinstance(content["robot"], str) and isinstance(content["deleted"], bool)
            and is_version(content["changed"]) and isinstance(earlier, list)
            and all(map(is_saved, [[content[name] for name in Version._fields], *earlier])))


def is_saved(content: Any) -> bool:
    """Return whether this is a Version's content."""
    if not isinstance(content, list) or len(content) != len(Version._fields):
        return False
    version, name, program = content
    return is_version(version) and is_program_name(name) and isinstance(program, str) and not problem_of(program)
