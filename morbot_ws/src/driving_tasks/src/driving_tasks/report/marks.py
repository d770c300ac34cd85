"""The mark of each drive, and tables of marks: CSV for the terminal, or in a file for a spreadsheet."""

import csv
import io
import itertools
import os
import re
from typing import Iterable, List, NamedTuple, Optional, Sequence

from jetbot import files
from jetbot.text import printable

from ..scoring.score import Result

COLUMNS = ("robot", "name", "task", "score", "seconds", "largest_loss", "problem", "source")
SIMULATOR = "simulator"
MAX_BODY = 100  # characters
FORMULA = re.compile(r'(^|[,;])([\s"]*[=+@＝＋＠－-])')  # of OWASP's list; where some spreadsheets begin a cell, too


class Mark(NamedTuple):
    """What the judge found: a result, or None and the problem in one sentence.

    name: of the person or the file, "" if it is not known; robot: its name, "" of a file; source: "" if the shipped
    simulator measured the drive, else "odometry", or how the simulator was changed: "simulator
    with max_speed 3 for 0.6".
    """

    name: str
    task: str
    result: Optional[Result] = None
    problem: str = ""
    source: str = ""
    robot: str = ""

    @property
    def row(self) -> Sequence[str]:
        """The row of a table with COLUMNS."""
        if not self.result:
            return self.robot, self.name, self.task, "", "", "", self.problem, ""
        score, seconds, loss = f"{self.result.score:.1f}", f"{self.result.drive.seconds:.1f}", self.result.largest_loss
        return self.robot, self.name, self.task, score, seconds, loss, "", self.source or SIMULATOR

    @property
    def label(self) -> str:
        """What the drive is called: its robot or its file."""
        return self.robot or self.name

    @property
    def sentences(self) -> List[str]:
        """What a person reads about the drive."""
        if not self.result:
            return [self.problem]
        summary = f"{self.task}: {self.result.score:.1f} of 100 points in {self.result.drive.seconds:.1f} s."
        return [summary, self.result.sentence, *filter(None, [self.note])]

    @property
    def note(self) -> str:
        """A sentence on a source other than the shipped simulator, else ""."""
        if self.source.startswith(SIMULATOR):
            return f"Driven in a {self.source}."
        return self.source and f"Measured by its {self.source}, not by the simulator."


def changed(body: str) -> str:
    """Return the source of a drive in a simulator. body: how its robot differs from the shipped one, or ""."""
    return body and f"{SIMULATOR} with {printable(body[:MAX_BODY])}"


def to_csv(columns: Sequence[str], rows: Iterable[Sequence[object]]) -> str:
    """Return a table as CSV, one line per row; without columns, its rows alone. No cell is a spreadsheet's formula."""
    table = io.StringIO()
    writer = csv.writer(table, lineterminator="\n")
    if columns:
        writer.writerow(columns)
    writer.writerows([_cell(value) for value in row] for row in rows)
    return table.getvalue()


def unused(file: str) -> str:
    """Return the name of a new file: metre_2.csv if metre.csv exists, because marks are never overwritten."""
    stem, suffix = os.path.splitext(file)
    numbered = (f"{stem}_{number}{suffix}" for number in itertools.count(2))
    return files.first_unused(itertools.chain([file], numbered))


class Table:
    """A file of marks, new with the first of them. ``file``: its name, "" until then; wanted: its name, if unused."""

    def __init__(self, wanted: str):
        self._wanted, self.file = wanted, ""

    def write(self, columns: Sequence[str], rows: Iterable[Sequence[object]]) -> None:
        """Write the whole table in one step. Raises OSError."""
        self.file = self.file or unused(self._wanted)
        files.replace(self.file, to_csv(columns, rows).encode("utf-8-sig"))  # so that spreadsheets know it is UTF-8


def _cell(value):
    """Return a cell on one line; an apostrophe before what a spreadsheet would calculate."""
    return FORMULA.sub(r"\1'\2", printable(value))
