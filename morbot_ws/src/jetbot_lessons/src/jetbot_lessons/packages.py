"""The packages that ROS and catkin find; what others hand in is read without entities, links or waiting."""

import itertools
import os
import re
import xml.etree.ElementTree as ET
from pathlib import Path
from shlex import quote
from typing import List, Optional, Union
from xml.parsers import expat

from catkin_pkg.package import InvalidPackage, Package, parse_package
from catkin_pkg.packages import find_package_paths

from jetbot.files import read

from . import Problem

NameOrFolder = Union[str, Path]  # of a package
MANIFEST = "package.xml"
NAME = re.compile(r"[A-Za-z][\w-]{,254}", re.ASCII)  # also of a folder
LEFT_OUT = "morbot: "  # begins what ./morbot setup writes into the CATKIN_IGNORE of a package that it leaves out
MAX_ENTRIES = 1000     # files and folders


def workspace() -> Path:
    """Return the source folder of the pupil's workspace: the one that holds this package, unless it is installed."""
    package = Path(__file__).resolve().parents[2]
    return package.parent if (package / MANIFEST).exists() else _search_path()[0]


def _search_path() -> List[Path]:
    return [Path(entry) for entry in os.environ.get("ROS_PACKAGE_PATH", "").split(":")]


def manifests(root: Path) -> List[Path]:
    """Return each package.xml below a folder that ROS and catkin do not ignore, in the order of their paths."""
    return sorted(root / place / MANIFEST for place in find_package_paths(str(root)))


def find(name: str) -> List[Path]:
    """Return the folders of the packages of this name: in the workspace, or else on the search path."""
    for root in (workspace(), *_search_path()):
        found = [file.parent for file in manifests(root) if name_in(file) == name]
        if found:
            return found
    return []


def folder(package: NameOrFolder) -> Path:
    """Return the source folder of a package, given by its name or its folder; raise InvalidPackage if there is none."""
    if isinstance(package, Path):
        return package
    found = find(package)
    if not found:
        raise InvalidPackage(f"There is no package {package} any more: ./morbot setup reports why")
    return found[0]


def find_handed_in(given: Path) -> Path:
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


def read_xml(file: Path) -> ET.Element:
    """Return the root of a small XML file. Raise any error of a parser, also for a file that defines entities.

    These may expand to more than the memory holds, and no file of ROS needs them.
    """
    content, parser = read(file), expat.ParserCreate()
    parser.EntityDeclHandler = _refuse_entity
    parser.Parse(content, True)
    return ET.fromstring(content)


def _refuse_entity(name, *_):
    raise ValueError(f"it defines the entity {name}: remove <!ENTITY ...>")


def parse(file: Path) -> Package:
    """Return the package that this package.xml describes. Raise InvalidPackage, in one line."""
    try:
        read_xml(file)  # it may be a FIFO, for which parse_package waits, or a bomb
        return parse_package(str(file), warnings=[])
    except Exception as error:  # catkin_pkg raises AttributeError, AssertionError and others, too
        reason = getattr(error, "strerror", None) or " ".join(str(getattr(error, "msg", error)).split())
        raise InvalidPackage(f"{file} cannot be read: {reason}: correct that, then ./morbot setup") from None


def name_in(file: Path) -> Optional[str]:
    """Return the name of the package that this package.xml describes; None if it cannot be read."""
    try:
        return read_xml(file).findtext("name").strip()
    except Exception:  # of a parser, or there is no name
        return None


def check_exists(package: str, source: str) -> Problem:
    """Return the problem, or None if ROS and catkin find the package; ``source`` is how to get it.

    Raise InvalidPackage for a package.xml of the workspace that cannot be read: ROS could not find any package.
    """
    if not NAME.fullmatch(Path(package).name):
        return "A package's name begins with a letter and has letters, digits and _: type the name of yours"
    for file in manifests(workspace()):
        parse(file)
    places = find(package)
    if not places:
        return _not_found(package, source)
    if (places[0] / "cmake").exists():  # catkin writes it where it installs a package
        return f"{places[0]} is installed, without its source: check a copy of the project, by its ./morbot check"
    if not (places[0] / "CMakeLists.txt").exists():
        return f"{places[0]} has no CMakeLists.txt: mv {quote(str(places[0]))} ~, then {source}"
    return None


def _not_found(package: str, source: str) -> str:
    """Return why the package is not found, as ./morbot setup has noted it, or how to get the package."""
    root = workspace()
    notes = [read(file).decode(errors="replace") for file in root.rglob(f"{package}/CATKIN_IGNORE")]
    return next((note[len(LEFT_OUT):].strip() for note in notes if note.startswith(LEFT_OUT)),
                f"There is no package {package} in {root}: {source}")


def check_built(package: str) -> Problem:
    """Return the problem, or None if catkin_make has built the package."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(Path(prefix, "share", package, "cmake").exists() for prefix in prefixes):
        return None
    return f"{package} is not built: ./morbot setup"
