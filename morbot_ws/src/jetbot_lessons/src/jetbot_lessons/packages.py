"""The packages that ROS and catkin find, read one by one: one that cannot be read does not hide the others."""

import os
import xml.etree.ElementTree as ET
from pathlib import Path
from typing import List, Optional, Union
from xml.parsers import expat

from catkin_pkg.package import InvalidPackage, Package, parse_package

from jetbot.files import read
from jetbot_tools.manifest import MANIFEST
from jetbot_tools.packages import find_folders, find_packages, ignore_marker

from . import Problem

NameOrFolder = Union[str, Path]  # of a package
XML_ERRORS = (ET.ParseError, expat.ExpatError, AttributeError, ValueError, LookupError, AssertionError, OSError,
              RecursionError)  # of any XML parser


def workspace() -> Path:
    """Return the source folder of the pupil's workspace: the one that holds this package, unless it is installed."""
    package = Path(__file__).resolve().parents[2]
    return package.parent if (package / MANIFEST).exists() else _search_path()[0]


def _search_path() -> List[Path]:
    return [Path(entry) for entry in os.environ.get("ROS_PACKAGE_PATH", "").split(":")]


def manifests(root: Path) -> List[Path]:
    """Return each package.xml below a folder that ROS and catkin do not ignore, in the order of their paths."""
    return [place / MANIFEST for place in find_folders(root)[0] if not ignore_marker(place, root)]


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


def name_in(file: Path) -> Optional[str]:
    """Return the name of the package that this package.xml describes; None if it cannot be read."""
    try:
        return read_xml(file).findtext("name").strip()
    except XML_ERRORS:
        return None


def read_xml(file: Path) -> ET.Element:
    """Return the root of a small XML file. Raise one of XML_ERRORS, also for a file that defines entities.

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
    except OSError as error:
        raise InvalidPackage(f"{file} cannot be read: {error.strerror}") from None
    except (InvalidPackage, *XML_ERRORS) as error:
        reason = " ".join(str(getattr(error, "msg", error)).split())
        raise InvalidPackage(f"{file} cannot be read: {reason}: correct that, then ./morbot setup") from None


def check_workspace() -> Problem:
    """Return the problem, or None if ROS and catkin can read each package of the workspace."""
    return next(iter(find_packages(workspace())[1]), None)
