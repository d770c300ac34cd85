"""Reads one package.xml, and reports what is wrong with it in one sentence."""

import os
import re
import stat
from pathlib import Path
from typing import NamedTuple, Optional
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
    """Return the package in this folder. Raise Problem if ROS cannot read it."""
    file = folder / MANIFEST
    if re.search("[:;\x00-\x1f]", str(folder)):
        raise Problem(f"ROS cannot use the folder name {ascii(str(folder))}: rename it, without : and ;")
    content = _read(file)
    problem = _xml_problem(content) or _manifest_problem(file, content)
    if problem:
        raise Problem(f"{file}{problem}. The package is left out until then.")
    package = _parse(file, content)
    return Package(package.name, folder, package.get_build_type())


def _read(file):
    """Return the content of a regular file; a FIFO would wait."""
    try:
        status = os.stat(file)
        if not stat.S_ISREG(status.st_mode) or status.st_size > MAX_SIZE:
            kind = "too large" if stat.S_ISREG(status.st_mode) else "not a regular file"
            raise Problem(f"{file} is {kind}: remove it, or mv {file.parent} ~. The package is left out until then.")
        return file.read_bytes()
    except FileNotFoundError:
        raise Problem(f"{file} is a link that leads nowhere: rm {file}. The package is left out until then.") from None
    except OSError as error:
        raise Problem(f"{file} cannot be read ({error.strerror}): chmod +r {file}. "
                      "The package is left out until then.") from None


def _xml_problem(content: bytes) -> Optional[str]:
    """Return where this is not XML, and what to do about it."""
    if not content.strip():
        return " is empty: remove its folder, or make it again with catkin_create_pkg"
    parser = expat.ParserCreate()
    opened = []
    parser.StartElementHandler = lambda name, _: opened.append((name, parser.CurrentLineNumber))
    parser.EndElementHandler = lambda _: opened.pop()
    try:
        parser.Parse(content, True)
    except expat.ExpatError as error:
        if opened and error.code in (expat.errors.codes[expat.errors.XML_ERROR_TAG_MISMATCH],
                                     expat.errors.codes[expat.errors.XML_ERROR_NO_ELEMENTS]):
            name, line = opened[-1]
            return f", line {line}: <{name}> has no end: add </{name}>"
        return (f", line {error.lineno}: {expat.ErrorString(error.code)}: is a quote, < or > missing there or before, "
                "or is & not written &amp;? Correct it")
    except (ValueError, LookupError) as error:
        return f", line 1: {error}: write encoding=\"utf-8\""
    return None


def _manifest_problem(file: Path, content: bytes) -> Optional[str]:
    """Return what a package.xml lacks, and what to do about it."""
    try:
        _parse(file, content).get_build_type()
    except UnicodeDecodeError as error:
        line = content[:error.start].count(b"\n") + 1
        return f", line {line}: this is not text in UTF-8: save the file in this encoding"
    except Exception as error:  # catkin_pkg raises what its parts raise: AssertionError, AttributeError, ValueError ...
        reason = " ".join(str(getattr(error, "msg", error)).split())
        missing = next((name for name in ELEMENTS if f'"{name}" tag' in reason or f"one {name}" in reason), None)
        if missing:
            return f": {reason}: add {ELEMENTS[missing].format(file.parent.name)}"
        return f": {reason}: correct it"
    return None


def _parse(file, content):
    from catkin_pkg.package import parse_package_string  # a tenth of a second, which only packages to read need
    package = parse_package_string(content.decode(), str(file), warnings=[])
    package.evaluate_conditions(os.environ)
    return package
