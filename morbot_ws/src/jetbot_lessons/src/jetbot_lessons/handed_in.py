"""A package that a pupil has handed in, anywhere on this computer: nothing in it is executed or trusted."""

import itertools
import os
from pathlib import Path

from catkin_pkg.package import InvalidPackage

from jetbot_tools.manifest import MANIFEST

from . import Problem

MAX_ENTRIES = 1000  # files and folders


def find_package(given: Path) -> Path:
    """Return the package's folder: the one given, or the only one in it with a package.xml; raise InvalidPackage."""
    try:
        with os.scandir(given) as entries:
            inside = sorted(Path(entry) for entry in itertools.islice(entries, MAX_ENTRIES)
                            if entry.is_dir(follow_symlinks=False))
    except OSError as error:
        raise InvalidPackage(f"{given} is no folder that can be read: {error.strerror}") from None
    found = [place for place in (given, *inside) if os.path.lexists(place / MANIFEST)]
    if len(found) > 1 and found[0] != given:
        raise InvalidPackage(f"{given} has {len(found)} packages: give the folder of one")
    if not found:
        raise InvalidPackage(f"There is no package in {given}: hand in the package's folder, with its {MANIFEST}")
    return found[0]


def check_files(place: Path) -> Problem:
    """Return the problem, or None if the package's folder is complete and small, and no link leads out of it."""
    home, count = place.resolve(), 0
    for parent, folders, names in os.walk(place):
        for path in (Path(parent, name) for name in sorted(folders + names)):
            count += 1
            if count > MAX_ENTRIES:
                return f"{place} has more than {MAX_ENTRIES:,} files: hand in the package alone"
            if path.is_symlink() and home not in Path(os.path.realpath(path)).parents:
                return f"{path} is a link that leads out of the package: hand in the file itself"
    if not (place / "CMakeLists.txt").is_file():
        return f"There is no CMakeLists.txt in {place}: hand in the whole package"
    return None
