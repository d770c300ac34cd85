"""Checks of a package's files."""

import ast
import os
import shutil
import xml.etree.ElementTree as ET
from pathlib import Path

from catkin_pkg.package import InvalidPackage, Package, parse_package
from rospkg import ResourceNotFound, RosPack

from jetbot.files import read

from . import Problem

XML_ERRORS = (ET.ParseError, AttributeError, ValueError, LookupError, AssertionError, OSError)  # of any XML parser
CONTROLLER_LAUNCH = "$(find jetbot_control_node)/launch/jetbot_controller.launch"
SHEBANG = "#!/usr/bin/env python3"
MAX_SCRIPT = 1024 * 1024  # bytes


def folder(package: str) -> Path:
    """Return the package's source folder. Raise ResourceNotFound, or InvalidPackage for any bad package.xml."""
    files = sorted(file for file in workspace().rglob("package.xml") if not file.is_dir())
    for file in files:
        _check_readable(file)  # rospkg waits for a FIFO
    try:
        return Path(RosPack().get_path(package))
    except XML_ERRORS as error:  # rospkg's, of any file; it does not name the file
        for file in files:
            parse(file)
        raise InvalidPackage(f"A package.xml in {workspace()} cannot be read: {error}") from None


def _check_readable(file: Path) -> None:
    try:
        read(file)
    except OSError as error:
        raise InvalidPackage(f"{file} cannot be read: {error.strerror}") from None


def workspace() -> Path:
    """Return the source folder of the pupil's workspace."""
    return Path(os.environ.get("ROS_PACKAGE_PATH", "").split(":")[0])


def parse(file: Path) -> Package:
    """Return the package that this package.xml describes. Raise InvalidPackage, in one line."""
    try:
        return parse_package(str(file))
    except (InvalidPackage, *XML_ERRORS) as error:
        reason = " ".join(str(getattr(error, "msg", error)).split())
        raise InvalidPackage(f"{file} cannot be read: {reason}") from None


def check_exists(package: str, source: str) -> Problem:
    """Return the problem, or None if ROS and catkin find the package; ``source`` is how to get it."""
    try:
        place = folder(package)
    except ResourceNotFound:
        return _not_found(package, source)
    return None if (place / "CMakeLists.txt").exists() else _incomplete(place, "CMakeLists.txt", source)


def _incomplete(place: Path, file: str, source: str) -> str:
    return f"{place} has no {file}: mv {place} ~, then {source}"


def _not_found(package: str, source: str) -> str:
    name, root = Path(package).name, workspace()
    similar = [known for known in RosPack().list() if known.lower() == name.lower()]
    if similar:
        return f"There is no package {package}, but there is {similar[0]}: type that name"
    places = [file.parent for file in root.rglob("package.xml") if file.parent.name == name]
    places += [parent / name for parent in root.parents if (parent / name / "package.xml").exists()]
    for place in places:
        if root in place.parents and not any((parent / "package.xml").exists() for parent in place.parents):
            return (f"{place / 'package.xml'} names another package: write <name>{name}</name> there, "
                    f"and project({name}) in CMakeLists.txt")
        return f"ROS does not search {place.parent} for packages: mv {place} {root}"
    for place in root / name, root / "scenarios" / name:
        if name and place.is_dir():
            return _incomplete(place, "package.xml", source)
    return f"There is no package {package} in {root}: {source}"


def check_built(package: str) -> Problem:
    """Return the problem, or None if catkin_make has built the package."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(Path(prefix, "share", package, "cmake").exists() for prefix in prefixes):
        return None
    return f"{package} is not built: ./morbot setup"


def check_depends(package: str, *names: str) -> Problem:
    """Return the problem, or None if package.xml names these packages as dependencies."""
    file = folder(package) / "package.xml"
    known = {dependency.name for dependency in parse(file).exec_depends}
    return next((f"{file} does not name {name}: add <exec_depend>{name}</exec_depend> before </package>"
                 for name in names if name not in known), None)


def check_scripts(package: str) -> Problem:
    """Return the problem, or None if the package has scripts and the system can start each."""
    scripts = folder(package) / "scripts"
    files = sorted(scripts.glob("[!.]*.py"))
    if not files:
        return f"There is no script in {scripts}: put one there, with a name that ends in .py"
    return next(filter(None, map(_check_script, files)), None)


def _check_script(path: Path) -> Problem:
    if not path.is_file():
        return f"{path} is not a file: remove it"
    try:
        source = read(path, MAX_SCRIPT)
    except OSError as error:
        return f"{path} cannot be read: {error.strerror}"
    first = source.partition(b"\n")[0].decode(errors="replace")
    if not first.startswith("#!"):
        return f"{path.name} does not begin with {SHEBANG}: make that the first line of {path}"
    if first.endswith("\r"):
        return fr"{path.name} has Windows line endings: sed -i 's/\r$//' {path}"
    if not _starts_ros_python(first):
        return f"{path.name} begins with {first}, which does not start ROS's Python: write {SHEBANG}"
    if not os.access(path, os.X_OK):
        return f"{path.name} is not executable: chmod +x {path}"
    try:
        ast.parse(source, path.name)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:  # ValueError: a zero byte, before 3.12
        return f"Python cannot read {path.name}: {error}"
    return None


def _starts_ros_python(first: str) -> bool:
    """Return whether a script with this first line runs in the Python for which ROS is installed."""
    words = [word for word in first[len("#!"):].split() if not word.startswith("-")] or [""]
    program = words[1] if words[0] in ("/usr/bin/env", "/bin/env") and len(words) > 1 else words[0]
    return Path(shutil.which(program) or "").resolve().match("/usr/bin/python3*")


def check_launch_files(package: str) -> Problem:
    """Return the problem, or None if a launch file includes the controller's and passes its arguments on."""
    launch = folder(package) / "launch"
    problems = [_check_launch_file(file) for file in sorted(launch.glob("*.launch"))]
    if not problems:
        return f"There is no launch file in {launch}: put one there, with a name that ends in .launch"
    return None if None in problems else problems[0]


def _check_launch_file(file: Path) -> Problem:
    try:
        passing = [include.get("pass_all_args") for include in ET.fromstring(read(file)).iter("include")
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
