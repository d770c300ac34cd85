#!/usr/bin/env python3
"""Compares what random programs in Python do in the page and on a computer; prints those that differ.

./morbot shell tests/unit/text_differential.py --programs 1000 --seed 1
"""

import argparse
import io
import json
import sys
import traceback
import warnings
from contextlib import redirect_stdout
from typing import Dict, Iterator, NamedTuple, Optional, Tuple

from javascript import node
from random_texts import random_text

BATCH = 50  # programs that one Node runs


class Done(NamedTuple):
    """What a program has printed, the type of the error that ended it, and its line."""

    prints: list
    error: Optional[str]
    line: Optional[int]


def run_texts(texts: Dict[str, str]) -> Dict[str, dict]:
    """Return what the page's engine does with texts; see tests/js/texts.js."""
    done = node("tests/js/texts.js", 10, input=json.dumps(texts))
    assert done.returncode == 0, done.stdout
    return json.loads(done.stdout)


def run_in_page(texts: Dict[str, str]) -> Dict[str, Done]:
    """Return what texts print in the page, and how they end."""
    return {name: done_in_page(each) for name, each in run_texts(texts).items()}


def done_in_page(done: dict) -> Done:
    """Return this of what the engine has done."""
    prints = [row for row in done["trace"] if isinstance(row, str)]
    problem = done["problem"] or {"type": done["error"] or None, "line": done["line"]}
    return Done(prints, problem["type"], problem["line"] and int(problem["line"]))


def run_here(text: str) -> Done:
    """Return what Python does with a text."""
    written, error, line = io.StringIO(), None, None
    with redirect_stdout(written), warnings.catch_warnings():
        try:
            warnings.simplefilter("ignore")  # what is wrong on purpose
            exec(compile(text, "program.py", "exec"), {"__name__": "__main__"})
        except Exception as failure:
            error, line = type(failure).__name__, line_of(failure)
    *prints, last = written.getvalue().split("\n")
    return Done(prints + [last] * bool(last), error, line)


def line_of(error: Exception) -> Optional[int]:
    """Return the line of the program in which an error was raised."""
    if isinstance(error, SyntaxError):
        return error.lineno
    frames = traceback.walk_tb(error.__traceback__)
    return [line for frame, line in frames if frame.f_code.co_filename == "program.py"][-1]


def difference(page: Done, here: Done) -> str:
    """Return what differs, or ""."""
    for number, (ours, theirs) in enumerate(zip(page.prints, here.prints)):
        if ours != theirs:
            return f"print {number}: {ours!r} in the page, {theirs!r} here"
    if page != here:
        return f"{len(page.prints)} prints, {page[1:]} in the page, {len(here.prints)}, {here[1:]} here"
    return ""


def random_differences(seed: int, count: int) -> Iterator[Tuple[int, str, str]]:
    """Yield the seed and the text of each program that differs, and what differs."""
    for start in range(seed, seed + count, BATCH):
        texts = {str(each): random_text(each) for each in range(start, min(start + BATCH, seed + count))}
        for name, page in run_in_page(texts).items():
            found = difference(page, run_here(texts[name]))
            if found:
                yield int(name), texts[name], found


def main() -> int:
    """Compare programs as the arguments say; return the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--programs", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1, help="of the first program; the next ones follow")
    arguments = parser.parse_args()
    failed = 0
    for seed, _, found in random_differences(arguments.seed * 1000000, arguments.programs):
        failed += 1
        print(f"program {seed}: {found}", flush=True)
    print(f"{arguments.programs} programs: {failed} differ")
    return int(bool(failed))


if __name__ == "__main__":
    sys.exit(main())
