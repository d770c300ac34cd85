"""What the lessons' pages have their reader do, box by box; the line above a box says what kind it is."""

import re
from pathlib import Path
from typing import NamedTuple

RUN, FILE = "run", "file"
LEAVE, FAILS, INTERNET, PRESS, SEE = "leave it running", "this fails", "with internet", "press", "you see"
HEADING = re.compile(
    rf"(?:Terminals? (?P<terminals>\d(?:(?:, | and )\d)*)(?:, (?P<how>{LEAVE}|{FAILS}|{INTERNET}|{PRESS}|{SEE}))?"
    r"|(?P<see>You see)|File `(?P<file>[^`]+)`):")
BOX = re.compile(r"^(?P<heading>[^\n]*)\n\n```(?P<language>\w*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
FENCES = re.compile(r"^```", re.MULTILINE)
DRAWING = "mermaid"


class Box(NamedTuple):
    """A box of a page: where it stands, what to do with it, in which terminals; for a FILE, its path."""

    place: str
    how: str
    terminals: tuple
    file: str
    text: str


def boxes(page):
    """The boxes of a page, in order; ValueError for one whose heading is none of those in HEADING."""
    text = Path(page).read_text()
    found = [match for match in BOX.finditer(text) if match["language"] != DRAWING]
    if 2 * (len(found) + text.count("```" + DRAWING)) != len(FENCES.findall(text)):
        raise ValueError(f"{page.name}: a box has no line above it that says what it is")
    terminals = ()
    for match in found:
        place = f"{page.name}:{text.count(chr(10), 0, match.start()) + 1}"
        heading = HEADING.fullmatch(match["heading"])
        if not heading:
            raise ValueError(f"{place}: {match['heading']!r} does not say what to do with the box below it")
        terminals = tuple(map(int, re.findall(r"\d", heading["terminals"] or ""))) or terminals
        how = SEE if heading["see"] else FILE if heading["file"] else heading["how"] or RUN
        yield Box(place, how, terminals, heading["file"], match["text"])


def pattern(text):
    """A regular expression for what a page shows: ``...`` is anything in a line, or any lines."""
    lines = [".*" if line == "..." else r"[^\n]*".join(map(re.escape, line.rstrip().split("...")))
             for line in text.splitlines()]
    source = "".join(line if line == ".*" else rf"^{line}[ \t]*$\n?" for line in lines)
    return re.compile(source, re.MULTILINE | re.DOTALL)
