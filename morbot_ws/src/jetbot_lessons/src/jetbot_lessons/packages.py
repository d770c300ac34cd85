"""The packages that ROS and catkin find, read one by one: one that cannot be read does not hide the others."""

import os
import shlex
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import Dict, Iterator, List, Optional

from catkin_pkg.package import InvalidPackage, Package, parse_package

from jetbot.files import read

from . import Problem

XML_ERRORS = (ET.ParseError, AttributeError, ValueError, LookupError, AssertionError, OSError)  # of any XML parser
MANIFEST = "package.xml"
IGNORE_MARKERS = {"CATKIN_IGNORE", "AMENT_IGNORE", "COLCON_IGNORE"}  # as catkin_pkg.packages has them


def workspace() -> Path:
    """Return the source folder of the pupil's workspace: the one that holds this package, unless it is installed."""
    package = Path(__file__).resolve().parents[2]
    return package.parent if (package / MANIFEST).exists() else _search_path()[0]


def _search_path() -> List[Path]:
    return [Path(entry) for entry in os.environ.get("ROS_PACKAGE_PATH", "").split(":")]


def manifests(root: Path) -> Iterator[Path]:
    """Yield each package.xml below a folder that catkin does not ignore, in the order of their paths."""
    seen = set()
    for folder, folders, names in os.walk(root, followlinks=True):
        if IGNORE_MARKERS.intersection(names + folders):
            folders.clear()
        elif MANIFEST in names:
            folders.clear()
            yield Path(folder, MANIFEST)
        else:
            folders[:] = sorted(name for name in folders if not name.startswith(".")
                                and os.path.realpath(folder) not in seen)
            seen.add(os.path.realpath(folder))  # a link may lead back here


def ignore_marker(place: Path) -> Optional[Path]:
    """Return the file that makes catkin and ROS ignore this folder of the workspace, or None."""
    folders = [parent for parent in (place, *place.parents) if workspace() in (parent, *parent.parents)]
    return next((each / name for each in folders for name in IGNORE_MARKERS if (each / name).exists()), None)


def find(name: str) -> List[Path]:
    """Return the folders of the packages of this name: in the workspace, or else on the search path."""
    for root in (workspace(), *_search_path()):
        found = [file.parent for file in manifests(root) if name_in(file) == name]
        if found:
            return found
    return []


def folder(name: str) -> Path:
    """Return the package's source folder; raise InvalidPackage if there is none."""
    found = find(name)
    if not found:
        raise InvalidPackage(f"There is no package {name} any more: ./morbot setup reports why")
    return found[0]


def name_in(file: Path) -> Optional[str]:
    """Return the name of the package that this package.xml describes; None if it cannot be read."""
    try:
        return ET.fromstring(read(file)).findtext("name").strip()
    except XML_ERRORS:
        return None


def parse(file: Path) -> Package:
    """Return the package that this package.xml describes. Raise InvalidPackage, in one line."""
    try:
        read(file)  # it may be a FIFO, for which parse_package waits
        return parse_package(str(file), warnings=[])
    except OSError as error:
        raise InvalidPackage(f"{file} cannot be read: {error.strerror}") from None
    except (InvalidPackage, *XML_ERRORS) as error:
        reason = " ".join(str(getattr(error, "msg", error)).split())
        raise InvalidPackage(f"{file} cannot be read: {reason}: correct that, then ./morbot setup") from None


def check_workspace() -> Problem:
    """Return the problem, or None if catkin can read each package of the workspace, and no two have the same name."""
    places: Dict[str, Path] = {}
    for file in manifests(workspace()):
        try:
            name = parse(file).name
        except InvalidPackage as error:
            return str(error)
        both = {file.parent, places.setdefault(name, file.parent)}
        if len(both) > 1:
            copy, original = sorted(both, key=lambda place: place.name == name)
            return (f"{original} and {copy} are both the package {name}: give the second a name of its own, as <name> "
                    f"in its {MANIFEST} and as project in its CMakeLists.txt, or mv {shlex.quote(str(copy))} ~")
    return None
