"""What a build leaves in the devel folder for the next one and for shells: the search path and the stamp."""

import os
from pathlib import Path
from typing import Collection, Iterable, List, NamedTuple

from jetbot_tools.manifest import Package
from stand_ins import stand_ins

STAMP = "morbot.stamp"


class Stamp(NamedTuple):
    """What was built, and when: later changes are not in it. ``time`` is also the file's own modification time."""

    source: str
    folders: List[Path]
    time: float


def read_stamp(devel: Path) -> Stamp:
    """Return the stamp of the last build; an empty one if there is none, or if it was interrupted."""
    try:
        source, *folders = (devel / STAMP).read_text().splitlines()
        return Stamp(source, [Path(folder) for folder in folders], (devel / STAMP).stat().st_mtime)
    except (FileNotFoundError, ValueError):
        return Stamp("", [], 0.0)


def write_stamp(devel: Path, stamp: Stamp) -> None:
    """Replace the stamp in one step."""
    _replace(devel / STAMP, "".join(f"{line}\n" for line in (stamp.source, *stamp.folders)), stamp.time)


def write_search_path(devel: Path, folders: Iterable[Path], time: float) -> None:
    """Write the folders in which ROS searches for packages; catkin and ROS read them from this file."""
    _replace(devel / ".catkin", ";".join(map(str, folders)), time)


def search_path(source: Path, devel: Path, packages: Collection[Package], problems: Iterable[str]) -> List[Path]:
    """Return the folders in which ROS searches: that of all packages, or of each that can be read or was built."""
    if not (problems and packages):
        return [source]
    return [*(package.folder for package in packages), *stand_ins(devel, source, packages)]


def _replace(file, text, time):
    new = file.with_name(f"{file.name}.{os.getpid()}")
    new.write_text(text)
    os.utime(new, (time, time))
    new.replace(file)
