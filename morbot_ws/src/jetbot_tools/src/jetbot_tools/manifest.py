"""Reads one package.xml, and reports what is wrong with it in one sentence."""

import os
import re
import stat
from pathlib import Path
from typing import NamedTuple
from xml.parsers import expat

MANIFEST = "package.xml"
MAX_SIZE = 1024 * 1024  # bytes
ELEMENTS = {"name": "<name>{}</name>", "version": "<version>0.0.1</version>", "license": "<license>MIT</license>",
            "description": "<description>What it does.</description>",
            "maintainer": '<maintainer email="you@example.com">You</maintainer>'}


class Problem(Exception):
    """Why a package is left out, and what to do about it, in one sentence."""


class Package(NamedTuple):
    """A package that ROS can read."""

    name: str
    folder: Path
    build_type: str


def read_package(folder: Path) -> Package:
    """Return the package in this folder. Raise Problem if ROS or catkin cannot read it."""
    file = folder / MANIFEST
    try:
        if re.search("[:;\x00-\x1f]", str(folder)):
            raise Problem(f": rename its folder {ascii(folder.name)}, without : and ;")
        build_file = folder / "CMakeLists.txt"
        if build_file.exists() and not build_file.is_file():  # CMake would wait for a FIFO
            raise Problem(f": {build_file} is not a regular file: mv {folder} ~")
        content = _read(file)
        _check_xml(content)
        return _parse(content, folder)
    except Problem as problem:
        raise Problem(f"{file}{problem}. Until then, the package is used as it was last built, or left out.") from None


def _read(file):
    try:
        status = os.stat(file)
        if not stat.S_ISREG(status.st_mode):  # a FIFO would wait
            raise Problem(f" is not a regular file: mv {file.parent} ~")
        if status.st_size > MAX_SIZE:
            raise Problem(f" is too large to describe a package: mv {file.parent} ~")
        return file.read_bytes().decode()
    except UnicodeDecodeError as error:
        raise Problem(f", line {_line(error)}: this is not text in UTF-8: save the file in this encoding") from None
    except FileNotFoundError:
        raise Problem(f" is a link that leads nowhere: rm {file}") from None
    except OSError as error:
        raise Problem(f" cannot be read ({error.strerror}): chmod +r {file}") from None


def _line(error):
    return error.object[:error.start].count(b"\n") + 1


def _check_xml(content):
    """Raise Problem if this is not XML; it names the element that has no end, where that is the cause."""
    if not content.strip():
        raise Problem(" is empty: make it again with catkin_create_pkg, or remove its folder")
    parser, opened = expat.ParserCreate(), []
    parser.StartElementHandler = lambda name, _: opened.append((name, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: opened.pop()
    parser.EntityDeclHandler = lambda name, *_: _refuse_entity(name, parser.CurrentLineNumber)
    try:
        parser.Parse(content.encode(), True)
    except expat.ExpatError as error:
        reason = expat.ErrorString(error.code)
        if opened and reason in (expat.errors.XML_ERROR_TAG_MISMATCH, expat.errors.XML_ERROR_NO_ELEMENTS):
            name, line = opened[-1]
            raise Problem(f", line {line}: <{name}> has no end: add </{name}>") from None
        raise Problem(f", line {error.lineno}: {reason}: add a missing quote, < or >; write &amp; for &") from None
    except (LookupError, ValueError) as error:
        raise Problem(f', line 1: {error}: write encoding="utf-8"') from None


def _refuse_entity(name, line):
    """Raise Problem: entities may expand to more than the memory holds, and no package needs them."""
    raise Problem(f", line {line}: it defines the entity {name}: remove <!ENTITY ...>")


def _parse(content, folder):
    from catkin_pkg.package import parse_package_string  # it takes a tenth of a second, and is not always needed
    try:
        package = parse_package_string(content, str(folder / MANIFEST), warnings=[])
        package.evaluate_conditions(os.environ)
        return Package(package.name, folder, package.get_build_type())
    except Exception as error:  # catkin_pkg raises AssertionError, AttributeError, ValueError and others, too
        reason = " ".join(str(getattr(error, "msg", error)).split())
    missing = next((name for name in ELEMENTS if f'"{name}" tag' in reason or f"one {name}" in reason), None)
    cure = f"add {ELEMENTS[missing].format(folder.name)}" if missing else "correct it"
    raise Problem(f": {reason.rstrip('.')}: {cure}")
