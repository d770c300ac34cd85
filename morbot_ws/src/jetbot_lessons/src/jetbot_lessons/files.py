"""Checks of a package's files."""

import ast
import os
import re
import shutil
from difflib import get_close_matches
from pathlib import Path
from shlex import quote

from jetbot.files import read
from jetbot_tools.packages import ignore_marker

from . import Problem
from .packages import (
    MANIFEST,
    XML_ERRORS,
    NameOrFolder,
    check_workspace,
    find,
    folder,
    manifests,
    name_in,
    parse,
    read_xml,
    workspace,
)

CONTROLLER_LAUNCH = "$(find jetbot_control_node)/launch/jetbot_controller.launch"
SHEBANG = "#!/usr/bin/env python3"
MAX_SCRIPT = 1024 * 1024  # bytes
NAME = re.compile(r"[A-Za-z][\w-]{,254}", re.ASCII)  # also of a folder


def check_exists(package: str, source: str) -> Problem:
    """Return the problem, or None if ROS and catkin find the package; ``source`` is how to get it."""
    if not NAME.fullmatch(Path(package).name):
        return "A package's name begins with a letter and has letters, digits and _: type the name of yours"
    problem = check_workspace()
    if problem:
        return problem
    places = find(package)
    if not places:
        return _not_found(package, source)
    return None if (places[0] / "CMakeLists.txt").exists() else _incomplete(places[0], "CMakeLists.txt", source)


def check_own(package: str) -> Problem:
    """Return the problem, or None if the package does not belong to ROS itself."""
    place = folder(package)
    if workspace() in place.parents or {Path("/usr"), Path("/opt")}.isdisjoint(place.parents):
        return None
    return f"{package} comes with ROS, in {place}: type the name of your own package"


def _incomplete(place: Path, file: str, source: str) -> str:
    return f"{place} has no {file}: mv {quote(str(place))} ~, then {source}"


def _not_found(package: str, source: str) -> str:
    name, root = Path(package).name, workspace()
    names = sorted(filter(None, map(name_in, manifests(root))))
    similar = [known for known in names if known.lower() == name.lower()] or get_close_matches(name, names, 1)
    if similar:
        return f"There is no package {package}, but there is {similar[0]}: type that name, or {source}"
    outside = [parent / name / MANIFEST for parent in root.parents]
    for file in [*root.rglob(MANIFEST), *filter(Path.exists, outside)]:
        if name in (file.parent.name, name_in(file)):
            return _not_searched(file.parent, name)
    for place in root / name, root / "scenarios" / name:
        if place.is_dir():
            return _incomplete(place, MANIFEST, source)
    return f"There is no package {package} in {root}: {source}"


def _not_searched(place: Path, name: str) -> str:
    """Return why the package in this folder is not found under this name."""
    root = workspace()
    marker = ignore_marker(place, root)
    if marker:
        reason = read(marker).decode(errors="replace").strip()
        if reason.startswith("morbot: "):  # written by ./morbot setup
            return reason[len("morbot: "):]
        return f"ROS and catkin ignore {place}: rm {quote(str(marker))}, then ./morbot setup"
    if root in place.parents and not any((parent / MANIFEST).exists() for parent in place.parents):
        return (f"{place / MANIFEST} names another package: write <name>{name}</name> there, "
                f"and project({name}) in CMakeLists.txt")
    return f"ROS does not search {place.parent} for packages: mv {quote(str(place))} {quote(str(root))}"


def check_built(package: str) -> Problem:
    """Return the problem, or None if catkin_make has built the package."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(Path(prefix, "share", package, "cmake").exists() for prefix in prefixes):
        return None
    return f"{package} is not built: ./morbot setup"


def check_depends(package: NameOrFolder, *names: str) -> Problem:
    """Return the problem, or None if package.xml names these packages as dependencies."""
    file = folder(package) / "package.xml"
    known = {dependency.name for dependency in parse(file).exec_depends}
    return next((f"{file} does not name {name}: add <exec_depend>{name}</exec_depend> before </package>"
                 for name in names if name not in known), None)


def check_scripts(package: NameOrFolder) -> Problem:
    """Return the problem, or None if the package has scripts and the system can start each."""
    scripts = folder(package) / "scripts"
    files = sorted(scripts.glob("[!.]*.py"))
    if not files:
        return f"There is no script in {scripts}: put one there, with a name that ends in .py"
    return next(filter(None, map(_check_script, files)), None)


def _check_script(path: Path) -> Problem:
    name = quote(str(path))
    if path.is_symlink() and not path.exists():
        return f"{path} is a link to {os.readlink(path)}, which does not exist: rm {name}"
    if not path.is_file():
        return f"{path} is not a file: mv {name} ~"
    try:
        source = read(path, MAX_SCRIPT)
    except OSError as error:
        return f"{path} cannot be read: {error.strerror}"
    if not source.strip():
        return f"{path} is empty: write your program into it, and save it"
    first = source.partition(b"\n")[0].decode(errors="replace")
    if not first.startswith("#!"):
        return f"{path.name} does not begin with {SHEBANG}: make that the first line of {path}"
    if first.endswith("\r"):
        return fr"{path.name} has Windows line endings: sed -i 's/\r$//' {name}"
    if not _starts_ros_python(first):
        return f"{path.name} begins with {first}, which does not start ROS's Python: write {SHEBANG}"
    if not os.access(path, os.X_OK):
        return f"{path.name} is not executable: chmod +x {name}"
    return _check_program(path.name, source)


def _check_program(name: str, source: bytes) -> Problem:
    try:
        program = ast.parse(source, name)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:  # ValueError: a zero byte, before 3.12
        return f"Python cannot read {name}: {str(error) or 'it is nested too deeply'}"
    return None if program.body else f"{name} holds no command yet: write your program into it, and save it"


def _starts_ros_python(first: str) -> bool:
    """Return whether a script with this first line runs in the Python for which ROS is installed."""
    words = [word for word in first[len("#!"):].split() if not word.startswith("-")] or [""]
    program = words[1] if words[0] in ("/usr/bin/env", "/bin/env") and len(words) > 1 else words[0]
    return Path(shutil.which(program) or "").resolve().match("/usr/bin/python3*")


def check_launch_files(package: NameOrFolder) -> Problem:
    """Return the problem, or None if a launch file includes the controller's and passes its arguments on."""
    launch = folder(package) / "launch"
    problems = [_check_launch_file(file) for file in sorted(launch.glob("*.launch"))]
    if not problems:
        return f"There is no launch file in {launch}: put one there, with a name that ends in .launch"
    return None if None in problems else problems[0]


def _check_launch_file(file: Path) -> Problem:
    try:
        passing = [include.get("pass_all_args") for include in read_xml(file).iter("include")
                   if include.get("file") == CONTROLLER_LAUNCH]
    except OSError as error:
        return f"{file} cannot be read: {error.strerror}"
    except XML_ERRORS as error:
        return f"{file} is not XML: {error}"
    if not passing:
        return (f"{file} does not include the controller: "
                f'add <include file="{CONTROLLER_LAUNCH}" pass_all_args="true"/> below <launch>')
    if "true" not in passing:
        return f'{file} does not pass its arguments on to the controller: write pass_all_args="true" in its <include>'
    return None
