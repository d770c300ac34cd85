"""What a page has its reader do, box by box; the line above a box names its kind."""

import re
from pathlib import Path
from typing import Iterator, NamedTuple, Optional, Tuple

RUN, FILE, ON_PAGE = "run", "file", "on the page"
LEAVE, FAILS, INTERNET, PRESS, SEE = "leave it running", "this fails", "with internet", "press", "you see"
HEADING = re.compile(
    rf"(?:Terminals? (?P<terminals>\d(?:(?:, | and )\d)*)(?:, (?P<how>{LEAVE}|{FAILS}|{INTERNET}|{PRESS}|{SEE}))?"
    r"|(?P<see>You see)|(?P<page>On the page, press)|File `(?P<file>[^`]+)`):")
NAMED = {"see": SEE, "page": ON_PAGE, "file": FILE}
BOX = re.compile(r"^(?P<heading>[^\n]*)\n\n```(?P<language>\w*)\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
FENCES = re.compile(r"^```", re.MULTILINE)
DRAWING = "mermaid"


class Box(NamedTuple):
    """A box of a page: its page and line, what to do with it, in which terminals; for a FILE, its path."""

    place: str
    how: str
    terminals: Tuple[int, ...]
    file: str
    text: str


def boxes(page: Path) -> Iterator[Box]:
    """Yield the boxes of a page in order; raise ValueError for one whose heading does not match HEADING."""
    text = page.read_text()
    matches = [match for match in BOX.finditer(text) if match["language"] != DRAWING]
    if 2 * (len(matches) + text.count("```" + DRAWING)) != len(FENCES.findall(text)):
        raise ValueError(f"{page.name}: a box has no line above it that names its kind")
    terminals = ()
    for match in matches:
        place = f"{page.name}:{text.count(chr(10), 0, match.start()) + 1}"
        heading = HEADING.fullmatch(match["heading"])
        if not heading:
            raise ValueError(f"{place}: {match['heading']!r} is no heading of a box")
        terminals = tuple(map(int, re.findall(r"\d", heading["terminals"] or ""))) or terminals
        how = next((how for group, how in NAMED.items() if heading[group]), heading["how"] or RUN)
        yield Box(place, how, terminals, heading["file"], match["text"])


def find(text: str, output: str, start: int) -> Optional[int]:
    """Return where in the output what a page shows ends, at ``start`` or later; None if it is not there.

    ``...`` is anything in a line, or any lines; what is between two of these is looked for by itself: one expression
    for all would try every combination of their places.
    """
    for block in re.split(r"^\.\.\.\n", text, flags=re.MULTILINE):
        lines = (r"[^\n]*".join(map(re.escape, line.rstrip().split("..."))) for line in block.splitlines())
        match = re.compile("".join(rf"^{line}[ \t]*$\n?" for line in lines), re.MULTILINE).search(output, start)
        if not match:
            return None
        start = match.end()
    return start
