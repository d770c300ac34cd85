"""Builds the packages of a workspace that can be built, and writes down what is wrong with the others.

build.py SOURCE BUILD DEVEL: the folders of a catkin workspace. The problems are in DEVEL/morbot.problems.
"""

import compileall
import contextlib
import os
import re
import shutil
import subprocess
import sys
import time
from pathlib import Path
from typing import Collection, Iterable, List, NamedTuple, Optional, Tuple

from build_log import failures, summary
from jetbot_tools.manifest import Package
from jetbot_tools.packages import find_packages, ignore_marker
from stand_ins import keep
from state import STAMP, Stamp, read_stamp, search_path, write_search_path, write_stamp

MORBOT_PACKAGES = ("driving_tasks", "jetbot_cockpit", "jetbot_control_node", "jetbot_lessons", "jetbot_tests",
                   "simulation", "workshop")
MAX_ATTEMPTS = 10  # a repository of a hundred packages that lack one library must not take an hour
READ_BY_CATKIN = "( -type d -o -name package.xml -o -name CMakeLists.txt -o -name setup.py )".split()


class BuildFailed(Exception):
    """The build failed, and no package is known to be the cause."""


class Spaces(NamedTuple):
    """The folders of a workspace."""

    source: Path
    build: Path
    devel: Path


def update(spaces: Spaces) -> None:
    """Build what has changed since the last build, and write each problem down. Raise BuildFailed or OSError."""
    link_to_catkin(spaces.source)
    compile_modules(spaces.source)
    started = time.time()
    last = read_stamp(spaces.devel)
    packages, problems = find_packages(spaces.source, last.folders)
    folders = search_path(spaces.source, spaces.devel, packages, problems)
    spaces.devel.mkdir(parents=True, exist_ok=True)
    write_search_path(spaces.devel, folders, started)
    if is_built(spaces.devel, packages, last):
        stamp = last._replace(time=started)
    else:
        whole = not problems and spaces.build.parent == spaces.source.parent
        source = spaces.source if whole else link_packages(spaces, packages)
        built, failed = build(spaces, source, packages, last)
        problems += failed
        stamp = Stamp(str(source), built, started)
        write_search_path(spaces.devel, folders, started)
    (spaces.devel / "morbot.problems").write_text("".join(f"morbot: {problem}\n" for problem in problems))
    keep(spaces.devel, spaces.source, {package.folder for package in packages}.intersection(stamp.folders))
    write_stamp(spaces.devel, stamp)


def link_to_catkin(source: Path) -> None:
    """Make the link that catkin_make would make: made during the build, it would look like a change after it."""
    file = source / "CMakeLists.txt"
    if not file.exists() and os.access(source, os.W_OK):
        with contextlib.suppress(FileNotFoundError):
            file.unlink()  # it leads to the catkin of another system
        subprocess.run(["catkin_init_workspace", str(source)], stdout=subprocess.DEVNULL, check=False)


def compile_modules(source: Path) -> None:
    """Compile all modules, as Python would at their first import: a new __pycache__ would look like a change."""
    if os.access(source, os.W_OK):
        compileall.compile_dir(str(source), quiet=2, rx=re.compile("/scripts/|/build/"))


def is_built(devel: Path, packages: Collection[Package], last: Stamp) -> bool:
    """Return whether the last build has each of these packages, unchanged."""
    folders = {package.folder for package in packages}
    if not folders or not folders <= {*last.folders} or not (devel / "setup.sh").exists():
        return False
    find = ["find", "-L", *map(str, folders), "-name", "__pycache__", "-prune", "-o", "-cnewer", str(devel / STAMP)]
    changed = subprocess.run([*find, *READ_BY_CATKIN, "-print"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                             check=False)
    return not changed.stdout


def link_packages(spaces: Spaces, packages: Iterable[Package]) -> Path:
    """Return a source folder with links to these packages alone."""
    source = spaces.build / "view/src"
    shutil.rmtree(source, ignore_errors=True)
    source.mkdir(parents=True)
    for package in packages:
        link = source / package.folder.relative_to(spaces.source)
        link.parent.mkdir(parents=True, exist_ok=True)
        link.symlink_to(package.folder)
    return source


def build(spaces: Spaces, source: Path, packages: Collection[Package], last: Stamp) -> Tuple[List[Path], List[str]]:
    """Build these packages, and again without those that fail; return the built folders and the problems."""
    print("morbot: building", file=sys.stderr)
    discard_interrupted(spaces, source, last)
    left_out = {package.name: not_for_catkin(package) for package in packages if package.build_type != "catkin"}
    for attempt in range(len(packages) + 1):
        log = catkin_make(spaces, source, left_out)
        if log is None:
            break
        found = failures(log, [package for package in packages if package.name not in left_out], spaces.source)
        if not found:
            raise BuildFailed(summary(log))
        left_out.update(found)
        if attempt == MAX_ATTEMPTS:
            left_out.update(never_built(packages, left_out, last))
    done = [package for package in packages if package.name not in left_out]
    unknown = [package for package in done
               if not ignore_marker(package.folder, spaces.source) and not is_known(spaces.devel, package)]
    problems = [*dict.fromkeys(left_out.values()), *map(without_catkin_package, unknown)]
    return [package.folder for package in done if package not in unknown], problems


def discard_interrupted(spaces: Spaces, source: Path, last: Stamp) -> None:
    """Remove CMake's cache after an interrupted build, or one of another folder, and the stamp before this one."""
    with contextlib.suppress(FileNotFoundError):
        (spaces.devel / STAMP).unlink()
    write_search_path(spaces.devel, [source], time.time())  # catkin would add the source folder to those of before
    if last.source != str(source):
        folder = build_folder(spaces, source)
        shutil.rmtree(folder / "CMakeFiles", ignore_errors=True)
        with contextlib.suppress(FileNotFoundError):
            (folder / "CMakeCache.txt").unlink()


def build_folder(spaces: Spaces, source: Path) -> Path:
    """Return where catkin builds this source folder."""
    return spaces.build if source == spaces.source else source.parent / "build"


def catkin_make(spaces: Spaces, source: Path, left_out: Iterable[str]) -> Optional[str]:
    """Build all packages but those that are left out. Return None, or what catkin_make printed if it failed."""
    log = spaces.build / "morbot.log"
    log.parent.mkdir(parents=True, exist_ok=True)
    with log.open("w") as output:
        code = subprocess.run(
            ["catkin_make", "-C", str(source.parent), "--source", str(source),
             "--build", str(build_folder(spaces, source)), f"-DCATKIN_DEVEL_PREFIX={spaces.devel}",
             "-DPYTHON_EXECUTABLE=/usr/bin/python3", f"-DCATKIN_BLACKLIST_PACKAGES={';'.join(left_out)}"],
            stdout=output, stderr=subprocess.STDOUT, check=False).returncode
    return log.read_text(errors="replace").replace(str(source), str(spaces.source)) if code else None


def is_known(devel: Path, package: Package) -> bool:
    """Return whether catkin knows the package; what a build before left there does not count for an empty file."""
    commands = re.sub("#.*", "", (package.folder / "CMakeLists.txt").read_text(errors="replace")).strip()
    return bool(commands) and (devel / "share" / package.name / "cmake").is_dir()


def never_built(packages: Iterable[Package], left_out: Collection[str], last: Stamp) -> dict:
    """Return {name: sentence} for the packages that were never built, and are not MorBot's own."""
    return {package.name: "All packages that were never built are left out until these are corrected."
            for package in packages
            if package.name not in (*left_out, *MORBOT_PACKAGES) and package.folder not in last.folders}


def not_for_catkin(package: Package) -> str:
    """Return what to do about a package that catkin does not build."""
    return (f"{package.folder}/package.xml is for {package.build_type}, which ROS 1 does not build: get the package's "
            f"version for ROS 1, or mv {package.folder} ~. It is left out until then.")


def without_catkin_package(package: Package) -> str:
    """Return what to do about a package that is not known to catkin after the build."""
    return (f"{package.folder}/CMakeLists.txt does not call catkin_package(): add that line after "
            "find_package(catkin REQUIRED ...).")


def main() -> None:
    """Build the workspace of the command line."""
    try:
        update(Spaces(*map(Path, sys.argv[1:])))
    except BuildFailed as error:
        sys.exit(f"morbot: the build failed: {error}")
    except OSError as error:
        sys.exit(f"morbot: the build failed: {error.filename}: {error.strerror}")
    except KeyboardInterrupt:
        sys.exit(130)


if __name__ == "__main__":
    main()
