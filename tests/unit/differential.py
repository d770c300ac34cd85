#!/usr/bin/env python3
"""Compares what random programs do in the page and as Python; makes those smaller that differ.

./morbot shell tests/unit/differential.py --programs 5000 --seed 1
"""

import argparse
import json
import sys
from collections import defaultdict
from typing import Dict, Iterator, List, Optional, Tuple, Union

from program_node import Run, run_python, translate

BATCH = 250  # programs that one Node translates
BLOCK = "block that failed"

# A part of the page's sentence, and what Python raises there
FAILURES = {
    "divides by 0": ZeroDivisionError,
    "has no result": (ValueError, OverflowError),
    "cannot be rounded": (ValueError, OverflowError),
    "cannot be compared": TypeError,
    "counts by 0": ValueError,
    "more than 998 deep": RecursionError,
    "loops in each other": SyntaxError,
}
# After these, Python may go on: see docs/blocks.md
STRICTER = ("Here a number is needed", "Only a number can be changed", "A text has at most", "is prime takes too long")


def difference(page: dict, python: Run) -> str:
    """Return what differs between the page and Python, or ""."""
    ours, theirs = compared(page["trace"]), compared(python.trace)
    if not all(map(alike, ours, theirs)):
        return "trace"
    if not page["exact"]:
        return ""
    if page["cut"]:
        return "" if python.cut or len(theirs) >= len(ours) else "end"
    return difference_of_ends(page, python, len(theirs) - len(ours))


def difference_of_ends(page: dict, python: Run, more: int) -> str:
    """Return what differs in how both end. more: what Python does that the page does not"""
    if any(sentence in page["error"] for sentence in STRICTER):
        return "" if more >= 0 else "trace"
    expected = next((error for sentence, error in FAILURES.items() if sentence in page["error"]), None)
    if page["error"] and not expected:
        return "unknown sentence"
    if python.cut or not isinstance(python.error, expected or type(None)):
        return "end"
    if expected in (RecursionError, SyntaxError):  # where, depends on the version of Python
        return ""
    if more:
        return "length"
    return BLOCK if expected and page_statement(page) != python_statement(page, python) else ""


def compared(trace: list) -> list:
    """Return what is printed, and (ms, "[x, z]") of each command that differs from the one before."""
    rows, last = [], [0.0, 0.0]
    for row in trace:
        if isinstance(row, str):
            rows.append(row)
            continue
        speeds = [round(float(value), 6) + 0.0 for value in row[1:]]
        if str(speeds) != str(last):
            rows.append((row[0], str(speeds)))
        last = speeds
    return rows


def alike(one: Union[str, tuple], other: Union[str, tuple]) -> bool:
    """Return whether two rows are the same; both clocks round to 1 ms."""
    if isinstance(one, str) or isinstance(other, str):
        return one == other
    return one[1] == other[1] and abs(one[0] - other[0]) <= 1


def blocks_of(block: dict, statement: Optional[dict] = None) -> Iterator[Tuple[dict, dict]]:
    """Yield each block of a program, and the statement that it is a part of."""
    statement = statement or block
    yield block, statement
    for name, slot in block.get("inputs", {}).items():
        starts = name.startswith(("DO", "STACK")) or (block["type"], name) == ("controls_if", "ELSE")
        for inner in filter(None, map(slot.get, ("block", "shadow"))):
            yield from blocks_of(inner, None if starts else statement)
    if "next" in block:
        yield from blocks_of(block["next"]["block"])


def page_statement(page: dict) -> Optional[str]:
    """Return the id of the statement in which the page failed."""
    pairs = (pair for top in page["program"]["blocks"]["blocks"] for pair in blocks_of(top))
    return next((statement["id"] for block, statement in pairs if block["id"] == page.get("block")), None)


def python_statement(page: dict, python: Run) -> Optional[str]:
    """Return the id of the statement in which Python failed: the mark above its line that is not indented deeper."""
    source, marks = page["python"].split("\n"), defaultdict(list)
    for block, line in page["lines"]:
        marks[line].append(block)
    found = (mark_above(source, marks, line - 1) for line in reversed(python.lines))
    return next(filter(None, found), None)


def mark_above(source: List[str], marks: Dict[int, List[str]], line: int) -> Optional[str]:
    """Return the id of the block that a line belongs to, from 0; None: to no block."""
    indentation = indentation_of(source[line])
    first = max(number for number in range(line + 1) if not indentation_of(source[number]))
    inside = [number for number in range(first, line + 1) if marks[number]]
    if source[line].startswith("    return"):  # the block that defines the function
        return marks[min(number for number in marks if number > first and marks[number])][0]
    outside = (number for number in reversed(inside) if indentation_of(source[number]) <= indentation)
    return next((marks[number][-1] for number in outside), None)


def indentation_of(text: str) -> int:
    return len(text) - len(text.lstrip())


def differences(translated: dict) -> Iterator[Tuple[str, dict, Run, str]]:
    """Yield each program that differs: its name, what the page does, what Python does, and what differs."""
    for name, page in translated.items():
        python = run_python(page["python"])
        found = difference(page, python)
        if found:
            yield name, page, python, found


def random_differences(seed: int, count: int) -> Iterator[Tuple[str, dict, Run, str]]:
    """Yield the differing ones of so many random programs, from this seed."""
    for start in range(seed, seed + count, BATCH):
        yield from differences(translate("random", start, min(start + BATCH, seed + count)))


def made_smaller(page: dict, python: Run, found: str) -> Tuple[dict, Run, str]:
    """Return the smallest program that still differs in the same way when a block is taken out of this one."""
    while True:
        smaller = differences(translate("smaller", programs=page["program"]))
        same = next((each for each in smaller if each[3] == found), None)
        if not same:
            return page, python, found
        _, page, python, found = same


def report(page: dict, python: Run, found: str) -> str:
    """Return what a person needs to see of a difference."""
    ours, theirs = compared(page["trace"]), compared(python.trace)
    return "\n".join([
        f"DIFFERS: {found}", json.dumps(page["program"], ensure_ascii=False), page["python"],
        f"page:   {ours[:30]} {page['error']} {page_statement(page)} cut: {page['cut']}",
        f"python: {theirs[:30]} {python.error!r} {python_statement(page, python)} cut: {python.cut}"])


def main() -> int:
    """Compare programs as the arguments say; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=int, default=5000)
    parser.add_argument("--seed", type=int, default=1, help="of the first program; the next ones follow")
    parser.add_argument("--list", action="store_true", help="list all differences, and make none smaller")
    arguments = parser.parse_args()
    seed, count = arguments.seed * 1000000, arguments.programs
    failed = 0
    for name, *found in random_differences(seed, count):
        failed += 1
        print(f"program {name}: {found[2]}: {found[0]['error']} / {found[1].error!r}", flush=True)
        if not arguments.list:
            print(report(*made_smaller(*found)))
            return 1
    print(f"{count} programs: {failed} differ")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
