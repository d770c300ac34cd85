"""Builds the packages of a workspace; one that cannot be read or built is left out: build.py SOURCE BUILD DEVEL.

What leaves it out is a file CATKIN_IGNORE in its folder, which catkin and ROS honour, with the reason as its text. The
next build removes the file and tries again. A CATKIN_IGNORE with another text is the user's, and stays.
"""

import glob
import re
import subprocess
import sys
from pathlib import Path
from typing import Dict

from catkin_pkg.package import parse_package
from catkin_pkg.packages import find_package_paths

MARKER, MARK = "CATKIN_IGNORE", "morbot: "
MAX_REASON = 300  # characters
GROUPS = (".", "scenarios")  # folders of packages, which are none themselves
CMAKE_ERROR = re.compile(r"^CMake Error.*?(?=^Call Stack|^-- |^CMake |\Z)", re.M | re.S)


def clear_markers(source: Path) -> None:
    """Remove the markers of the last build."""
    for file in map(Path, glob.iglob(f"{source}/**/{MARKER}", recursive=True)):
        if file.read_text(errors="replace").startswith(MARK):
            file.unlink()


def leave_out(folder: Path, reason: str) -> None:
    """Mark the package in this folder."""
    said = " ".join(reason.split())[:MAX_REASON].rstrip(".")
    (folder / MARKER).write_text(f"{MARK}{folder} is left out: {said}. Correct it, then: ./morbot setup\n")


def leave_out_unreadable(source: Path) -> Dict[str, Path]:
    """Leave out the packages that catkin cannot read, and copies; return the others: {name: folder}."""
    packages: Dict[str, Path] = {}
    for place in find_package_paths(str(source)):
        folder = source / place
        if place in GROUPS:
            sys.exit(f"morbot: {folder}/package.xml hides all packages in its folder: mv {folder}/package.xml ~")
        try:
            package = parse_package(str(folder), warnings=[])
        except Exception as error:  # catkin_pkg raises AttributeError, AssertionError and others, too
            leave_out(folder, str(error))
            continue
        if package.get_build_type() != "catkin":
            leave_out(folder, f"its package.xml is for {package.get_build_type()}, which ROS 1 does not build")
            continue
        original, copy = sorted([folder, packages.get(package.name, folder)], key=lambda each: (
            each.name != package.name, (each / "package.xml").stat().st_mtime))
        packages[package.name] = original
        if copy != original:
            leave_out(copy, f"its package.xml has the same <name> as {original}")
    return packages


def catkin_make(source: Path, build: Path, devel: Path) -> str:
    """Build; return what was printed if that failed, else nothing."""
    log = build / "morbot.log"
    with log.open("w") as output:
        code = subprocess.run(
            ["catkin_make", "-C", source.parent, "--source", source, "--build", build,
             f"-DCATKIN_DEVEL_PREFIX={devel}", "-DPYTHON_EXECUTABLE=/usr/bin/python3"],
            stdout=output, stderr=subprocess.STDOUT, check=False).returncode
    return log.read_text(errors="replace") if code else ""


def failures(log: str, places: Dict[str, str]) -> Dict[str, str]:
    """Return {name: reason} of the packages that could not be built. places: {name: folder below the source folder}."""
    found = {}
    for name, place in places.items():
        section = log.partition(f"-- ==> add_subdirectory({place})\n")[2].partition("-- ==> add_subdirectory(")[0]
        error = CMAKE_ERROR.search(section)
        if not error and re.search(rf"\*\*\* \[(\S+: )?{re.escape(place)}/", log):
            error = re.search(rf".*{re.escape(place)}/.*\berror\b.*", log, re.I)
        if error:
            line = re.search(rf"{re.escape(place)}/\S+:\d+", section)  # in the message, or in its call stack
            found[name] = f"{line[0] if line else ''} {error[0]}"
    error = CMAKE_ERROR.search(log)
    if error and not found:  # packages that need each other are named in the message
        found = {name: error[0] for name in places if re.search(rf"(?<!\S){re.escape(name)}\b", error[0])}
    return found


def main(source: Path, build: Path, devel: Path) -> None:
    clear_markers(source)
    packages = leave_out_unreadable(source)
    print("morbot: building", file=sys.stderr)
    while True:
        log = catkin_make(source, build, devel)
        failed = failures(log, {name: str(folder.relative_to(source)) for name, folder in packages.items()})
        if log and not failed:
            sys.exit(f"{log[-2000:]}\nmorbot: the build failed; all that it printed is in {build}/morbot.log")
        if not failed:
            return
        for name, reason in failed.items():
            leave_out(packages.pop(name), reason)


if __name__ == "__main__":
    try:
        main(*map(Path, sys.argv[1:]))
    except OSError as error:
        sys.exit(f"morbot: the build failed: {error}")
    except KeyboardInterrupt:
        sys.exit(130)
