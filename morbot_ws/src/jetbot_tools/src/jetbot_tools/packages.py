"""Finds the packages of a workspace that ROS can read, and what is wrong with the others.

A package.xml that cannot be read ends every ROS command that searches its folder.
"""

import os
from pathlib import Path
from typing import Collection, Dict, List, Optional, Tuple

from .manifest import MANIFEST, Package, Problem, read_package

IGNORE_MARKERS = ("CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE")  # as catkin_pkg has them; ROS knows the first


def find_packages(source: Path, known: Collection[Path] = ()) -> Tuple[List[Package], List[str]]:
    """Return the packages below a folder that ROS can read, and one sentence for each problem.

    Of two packages of one name, the one in ``known`` is the original, or else the one whose folder has the name.
    """
    folders, problems = find_folders(source)
    packages = []
    for folder in folders:
        try:
            packages.append(read_package(folder))
        except Problem as problem:
            problems.append(str(problem))
    originals: Dict[str, Package] = {}
    for package in sorted(packages, key=lambda package: _original_first(package, known)):
        original = originals.setdefault(package.name, package)
        if original is not package:
            problems.append(_name_problem(package, original))
    return sorted(originals.values()), problems


def find_folders(source: Path) -> Tuple[List[Path], List[str]]:
    """Return the folders of all packages, and one sentence for each package.xml or link that misleads ROS."""
    folders, problems, seen = [], [], set()
    for place, subfolders, files in os.walk(source, followlinks=True):
        seen.add(os.path.realpath(place))
        if IGNORE_MARKERS[0] in files:
            subfolders.clear()
        elif (MANIFEST in files or MANIFEST in subfolders) and not _holds_packages(place, subfolders):
            folders.append(Path(place))
            subfolders.clear()
        elif MANIFEST in files:
            problems.append(f"{place}/{MANIFEST} hides the packages in its folder from ROS: mv {place}/{MANIFEST} ~")
        links = [os.path.join(place, name) for name in subfolders if os.path.islink(os.path.join(place, name))]
        again = [link for link in links if _leads_back(os.path.realpath(link), os.path.realpath(source), seen)]
        problems += [f"{link} leads to a folder that ROS searches already: rm {link}" for link in again]
        subfolders[:] = sorted(name for name in subfolders
                               if name[0] != "." and os.path.join(place, name) not in again)
    return folders, problems


def ignore_marker(folder: Path, source: Path) -> Optional[Path]:
    """Return the file that makes catkin ignore this folder of the source folder, or None."""
    places = [place for place in (folder, *folder.parents) if source in (place, *place.parents)]
    return next((place / name for place in places for name in IGNORE_MARKERS if (place / name).exists()), None)


def _holds_packages(place, subfolders):
    return any(os.path.lexists(os.path.join(place, name, MANIFEST)) for name in subfolders)


def _leads_back(target, source, seen):
    return target in seen or os.path.commonpath([target, source]) in (target, source)


def _original_first(package, known):
    folder = package.folder
    return folder not in known, folder.name != package.name, (folder / MANIFEST).stat().st_mtime, folder


def _name_problem(copy, original):
    new = copy.folder.name if copy.folder.name != copy.name else "NEW"
    return (f"{copy.folder / MANIFEST} has the same <name> as {original.folder}: write <name>{new}</name> there and "
            f"project({new}) in its CMakeLists.txt, or mv {copy.folder} ~. The copy is left out until then.")
