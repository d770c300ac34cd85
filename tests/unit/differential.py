#!/usr/bin/env python3
"""Compares what random programs do in the page and as Python; makes those smaller that differ.

./morbot shell tests/unit/differential.py blocks --programs 5000 --seed 1
"""

import argparse
import ast
import itertools
import json
import time
from collections import defaultdict
from contextlib import suppress
from typing import Callable, Dict, Iterator, List, NamedTuple, Optional, Tuple, Union

from program_node import Run, run_python, run_text, translate
from random_texts import random_text
from restyled import restyled

BLOCK = "block that failed"
SHRINKING = 60  # s for which a program is made smaller

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


def text_difference(page: dict, python: Run) -> str:
    """Return what differs in what a text prints, and in how and where it fails, or ""."""
    problem = page["problem"] or {"type": "NoneType", "line": None}
    if page["prints"] != python.trace:
        return "prints"
    if problem["type"] != type(python.error).__name__:
        return "end"
    line = python.lines[-1] if python.error else None
    return "" if line == problem["line"] or in_one_statement(page["python"], line, problem["line"]) else "line"


def in_one_statement(source: str, *lines: int) -> bool:
    """Return whether lines belong to one statement: in which of its lines it fails, depends on the Python."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.stmt) and node.lineno <= min(lines):
            body = getattr(node, "body", [])
            if max(lines) <= (max(node.lineno, body[0].lineno - 1) if body else node.end_lineno):
                return True
    return False


def run_texts(texts: Dict[str, str]) -> Dict[str, dict]:
    """Return what the page does with texts, and the texts."""
    return {name: {**page, "python": texts[name]} for name, page in translate("texts", programs=texts).items()}


def random_texts(start: int, end: int) -> Dict[str, dict]:
    """Return what the page does with the texts of these seeds, each in a style of its own."""
    return run_texts({str(seed): restyled(random_text(seed), seed) for seed in range(start, end)})


def shorter(text: str) -> Iterator[str]:
    """Yield programs without one of the lines, and without what is indented below it; those first that lack most."""
    lines, ends = text.splitlines(keepends=True), {}
    for number, line in enumerate(lines):
        below = [each for each in range(number + 1, len(lines)) if lines[each].strip()
                 and indentation_of(lines[each]) <= indentation_of(line)]
        ends[number] = min(below, default=len(lines))
    for number in sorted(ends, key=lambda each: each - ends[each]):
        less = "".join(lines[:number] + lines[ends[number]:])
        with suppress(SyntaxError):
            ast.parse(less)
            yield less


def smaller_texts(page: dict) -> Iterator[Dict[str, dict]]:
    """Yield what the page does with texts that have less in them, some at a time."""
    texts = shorter(page["python"])
    for some in iter(lambda: list(itertools.islice(texts, 8)), []):
        yield run_texts(dict(zip("abcdefgh", some)))


class Kind(NamedTuple):
    """A kind of programs: what the page does with random ones, and with what one becomes if a part is taken out."""

    random: Callable[[int, int], Dict[str, dict]]  # those of the seeds from the first number to before the second
    smaller: Callable[[dict], Iterator[Dict[str, dict]]]
    run: Callable[[str], Run]  # its Python
    difference: Callable[[dict, Run], str]
    batch: int  # programs that one Node runs


KINDS = {
    "blocks": Kind(lambda start, end: translate("random", start, end),
                   lambda page: iter([translate("smaller", programs=page["program"])]), run_python, difference, 250),
    "texts": Kind(random_texts, smaller_texts, run_text, text_difference, 50),
}


class Difference(NamedTuple):
    """A program that differs: its name, what the page does, what Python does, and what differs."""

    name: str
    page: dict
    python: Run
    found: str


def differences(kind: str, pages: Dict[str, dict]) -> Iterator[Difference]:
    """Yield each program that differs, of those that the page has run."""
    for name, page in pages.items():
        python = KINDS[kind].run(page["python"])
        found = KINDS[kind].difference(page, python)
        if found:
            yield Difference(name, page, python, found)


def random_differences(kind: str, seed: int, count: int) -> Iterator[Difference]:
    """Yield the differing ones of so many random programs, from this seed."""
    batch = KINDS[kind].batch
    for start in range(seed, seed + count, batch):
        yield from differences(kind, KINDS[kind].random(start, min(start + batch, seed + count)))


def made_smaller(kind: str, differs: Difference) -> Difference:
    """Return the smallest program found that differs in the same way when a part is taken out of this one."""
    deadline = time.monotonic() + SHRINKING
    while time.monotonic() < deadline:
        smaller = (each for pages in KINDS[kind].smaller(differs.page) for each in differences(kind, pages))
        same = next((each for each in smaller if each.found == differs.found), None)
        if not same:
            break
        differs = same
    return differs


def report(differs: Difference) -> str:
    """Return what a person needs to see of a difference."""
    _, page, python, found = differs
    ours, theirs = compared(page["trace"]), compared(python.trace)
    first = next((number for number, rows in enumerate(zip(ours, theirs)) if rows[0] != rows[1]), 0)
    return "\n".join([
        f"DIFFERS: {found}", json.dumps(page.get("program"), ensure_ascii=False), page["python"],
        f"page:   {ours[first:first + 30]} {page['error']} {page.get('block')} cut: {page['cut']}",
        f"python: {theirs[first:first + 30]} {python.error!r} {python.lines[-1:]} cut: {python.cut}"])


def check(kind: str, seed: int, count: int) -> None:
    """Fail with the first of so many random programs that differs, made smaller."""
    for differs in random_differences(kind, seed, count):
        raise AssertionError(f"program {differs.name}\n{report(made_smaller(kind, differs))}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("kind", choices=KINDS)
    parser.add_argument("--programs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1, help="of the first program, in millions; the next ones follow")
    arguments = parser.parse_args()
    check(arguments.kind, arguments.seed * 1000000, arguments.programs)
    print(f"{arguments.programs} programs do the same")
