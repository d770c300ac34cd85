"""The files in a folder that somebody handed in, however deep, large or odd it is."""

import os
from pathlib import Path
from typing import List, NamedTuple, Tuple

from jetbot import InvalidValue

MAX_FILES = 1000
MAX_DEPTH = 8  # folders below each other


class Found(NamedTuple):
    """A file, or what cannot be used and why, in one sentence; name: what it is called in a table."""

    path: Path
    name: str
    problem: str = ""


def find_files(path: Path, *suffixes: str, without: Tuple[str, ...] = ()) -> List[Found]:
    """Return a file, or what is below a folder and ends in one of the suffixes, in the order of the paths.

    without: names that do not count. Links are not followed. What is too much or cannot be read
    is found with a problem. Raises InvalidValue for nothing.
    """
    if not path.is_dir():
        return [Found(path, path.name)]
    found = sorted(file for file in _search(path, suffixes) if file.path.name not in without)
    if not found:
        raise InvalidValue(f"there is no file that ends in {suffixes[0]} in {path}")
    if len(found) > MAX_FILES:
        found[MAX_FILES:] = [Found(path, path.name, f"It holds more than {MAX_FILES:,} files: only these are judged.")]
    return found


def _search(root, suffixes):
    closed = []
    for parent, folders, names in os.walk(root, onerror=closed.append):
        place = Path(parent)
        if len(place.relative_to(root).parts) == MAX_DEPTH:
            yield _found(root, place, f"It is more than {MAX_DEPTH} folders deep.")
            folders.clear()
            continue
        for path in (place / name for name in names + folders if name.endswith(suffixes)):
            if path.is_symlink():
                yield _found(root, path, "It is a link: hand in the file itself.")
            elif not path.is_dir():
                yield _found(root, path, "" if path.is_file() else "It is not a regular file.")
    for error in closed:
        yield _found(root, Path(error.filename), f"It cannot be opened: {error.strerror}.")


def _found(root, path, problem):
    return Found(path, str(path.relative_to(root)), problem)
