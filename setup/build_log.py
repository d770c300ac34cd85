"""Finds out, from what catkin_make printed, which packages could not be built, and why."""

import re
from pathlib import Path
from typing import Dict, Iterable, NamedTuple

from manifest import Package

CURES = [  # what CMake or catkin says, and what to do about it
    (r'configuration file provided by "(?P<what>[^"]+)"',
     "there is no package {what} to build with: correct its name, or install it"),
    (r"does not match current PROJECT_NAME", "write project({name}): the same name as in package.xml"),
    (r"called with non-existing file '(?P<what>[^']+)'", "there is no file {what}: correct its name"),
    (r"does not contain a CMakeLists.txt", "there is no such file: write one, or mv {folder} ~"),
    (r'Unknown CMake command "(?P<what>[^"]+)"', "there is no command {what}: correct its name"),
    (r"Circular dependency", "{name} and a package that it needs also need each other: remove one dependency"),
    (r"^metapackage$", "a metapackage's has cmake_minimum_required, project, find_package(catkin REQUIRED) and "
     "catkin_metapackage(), and nothing else: correct it"),
    (r"Parse error|Function missing ending", "a bracket or a quote is missing there or before: add it"),
]
ERROR = re.compile(r"^CMake Error(?: at (.*?:\d+))?.*?\n(.*?)(?=^-- |^CMake |\Z)", re.M | re.S)  # place, text


class _Error(NamedTuple):
    file: str  # below the source folder
    line: str  # or empty
    text: str


def failures(log: str, packages: Iterable[Package], source: Path) -> Dict[str, str]:
    """Return {name: one sentence} for each package below the source folder that could not be built."""
    found = {}
    for package in packages:
        folder = str(package.folder.relative_to(source))
        error = _workspace_error(log, folder, package.name) or _cmake_error(log, folder) or _compiler_error(log, folder)
        if error:
            place = f"{source / error.file}, line {error.line}" if error.line else str(source / error.file)
            found[package.name] = f"{place}: {_advice(error, package)}. Until then, {package.name} is not built."
    return found


def _workspace_error(log, folder, name):
    """Return the error that catkin finds before it reads the package's CMakeLists.txt."""
    if re.search(rf"Circular dependency in subset of packages:\s+[^\n]*\b{re.escape(name)}\b", log):
        return _Error(f"{folder}/package.xml", "", "Circular dependency")
    if re.search(rf"metapackage '{re.escape(name)}' contains non standard content", log):
        return _Error(f"{folder}/CMakeLists.txt", "", "metapackage")
    return None


def _cmake_error(log, folder):
    """Return the first error while CMake reads the package in this folder."""
    start = rf"^-- ==> add_subdirectory\({re.escape(folder)}\)$"
    section = re.search(rf"{start}(.*?)(?=^-- (?:\+\+\+ processing|Configuring)|\Z)", log, re.M | re.S)
    error = section and ERROR.search(section[1])
    if not error:
        return None
    places = [error[1] or "", *re.findall(r"^ +(\S.*?:\d+)", error[2], re.M)]  # and the call stack
    place = next((place for place in places if place.startswith(f"{folder}/")), f"{folder}/CMakeLists.txt:")
    return _Error(*place.rsplit(":", 1), " ".join(error[2].partition("Call Stack")[0].split()))


def _compiler_error(log, folder):
    """Return the first error while make builds the package."""
    place = re.escape(folder)
    if not re.search(rf"\*\*\* \[(?:\S+: )?{place}/", log):
        return None
    error = re.search(rf"^/.*?/({place}/.*?):(\d+):(?:\d+:)? (?:fatal )?error: (.*)", log, re.M)
    cause = error.groups() if error else (f"{folder}/CMakeLists.txt", "", "build/morbot.log has the reason")
    return _Error(*cause)


def _advice(error, package):
    for says, cure in CURES:
        match = re.search(says, error.text)
        if match:
            return cure.format(name=package.name, folder=package.folder, **match.groupdict())
    return error.text.rstrip(".")


def summary(log: str) -> str:
    """Return the cause of a failure that is no package's, or the lines of the log that may show it."""
    if "No space left on device" in log:
        return "the disk is full; make room on it"
    lines = [line for line in log.splitlines() if re.search("error|fail|denied|cannot", line, re.I)]
    return "\n".join(["what catkin_make printed is in build/morbot.log:", *(lines or log.splitlines())[-12:]])
