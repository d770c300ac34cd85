"""Finds the files in a folder that somebody handed in, however deep, large or odd it is."""

import itertools
import os
from pathlib import Path
from typing import Iterator, List, NamedTuple, Tuple

MAX_FILES = 1000      # that are found
MAX_ENTRIES = 20_000  # that are looked at
MAX_DEPTH = 8         # folders below each other


class Found(NamedTuple):
    """A file, or what cannot be used and why, in one sentence."""

    path: Path
    problem: str = ""


def find_files(folder: Path, *suffixes: str) -> List[Found]:
    """Return what is below a folder and ends in one of the suffixes, in the order of the paths. Links are not followed.

    What is too much or cannot be read is found with a problem, never raised.
    """
    found = list(itertools.islice(_search(folder, suffixes, MAX_DEPTH, itertools.count(1)), MAX_FILES + 1))
    if len(found) > MAX_FILES:
        found[MAX_FILES:] = [Found(folder, f"It holds more than {MAX_FILES:,} files: only these are judged.")]
    return found


def name_below(folder: Path, file: Path) -> str:
    """Return what a file is called in a table: its path below the folder, or its name if it is the folder itself."""
    return str(file.relative_to(folder)) if file != folder else folder.name


def _search(folder: Path, suffixes: Tuple[str, ...], depth: int, count: Iterator[int]) -> Iterator[Found]:
    if not depth:
        yield Found(folder, f"It is more than {MAX_DEPTH} folders deep.")
        return
    try:
        with os.scandir(folder) as entries:
            inside = sorted(itertools.islice(entries, MAX_ENTRIES), key=lambda entry: entry.name)
    except OSError as error:
        yield Found(folder, f"It cannot be opened: {error.strerror}.")
        return
    for entry in inside:
        number = next(count)
        if number > MAX_ENTRIES:
            if number == MAX_ENTRIES + 1:
                yield Found(folder, f"There are more than {MAX_ENTRIES:,} files and folders: the others are left out.")
            return
        if entry.is_dir(follow_symlinks=False):
            yield from _search(Path(entry.path), suffixes, depth - 1, count)
        elif entry.name.endswith(suffixes):
            yield Found(Path(entry.path), _problem(entry))


def _problem(entry):
    if entry.is_symlink():
        return "It is a link: hand in the file itself."
    return "" if entry.is_file(follow_symlinks=False) else "It is not a regular file."
