"""Checks of a package's files."""

import ast
import os
import shutil
import tokenize
import xml.etree.ElementTree as ET
from pathlib import Path

from catkin_pkg.package import InvalidPackage, parse_package
from rospkg import ResourceNotFound, RosPack

ODD_XML = (ValueError, LookupError, AssertionError, OSError)  # what parsers raise beside their own errors
CONTROLLER_LAUNCH = "$(find jetbot_control_node)/launch/jetbot_controller.launch"


def folder(package):
    """The package's source folder; ResourceNotFound where there is none, InvalidPackage where any cannot be read."""
    try:
        return Path(RosPack().get_path(package))
    except (ET.ParseError, AttributeError, *ODD_XML) as error:  # rospkg's, of any package.xml that it cannot read
        sentences = filter(None, map(unreadable, sorted(workspace().rglob("package.xml"))))
        raise InvalidPackage(next(sentences, f"A package.xml in {workspace()} cannot be read: {error}")) from None


def workspace():
    """The folder of the pupil's packages."""
    return Path(os.environ.get("ROS_PACKAGE_PATH", "").split(":")[0])


def unreadable(package_xml):
    """Whether the file describes a package."""
    try:
        parse_package(str(package_xml))
    except InvalidPackage as error:
        return " ".join(str(error).split())  # several lines, which name the file
    except ODD_XML as error:
        return f"{package_xml} cannot be read: {error}"
    return None


def found(package, source):
    """Whether ROS finds the package, and catkin can; source: the command that brings it there."""
    try:
        place = folder(package)
    except ResourceNotFound:
        return not_found(package, source)
    return None if (place / "CMakeLists.txt").exists() else incomplete(place, "CMakeLists.txt", source)


def incomplete(place, file, source):
    """The sentence about a package without one of its files."""
    return f"{place} has no {file}: mv {place} ~, then {source}"


def not_found(package, source):
    """The sentence about a package that ROS does not find."""
    name = Path(package).name
    alike = [known for known in RosPack().list() if known.lower() == name.lower()]
    if alike:
        return f"There is no package {package}, but there is {alike[0]}: type that name"
    outside = [parent / name for parent in workspace().parents if (parent / name / "package.xml").exists()]
    inside = [file.parent for file in workspace().rglob("package.xml") if file.parent.name == name]
    for place in inside + outside:
        if place in outside or any((parent / "package.xml").exists() for parent in place.parents):
            return f"{place} lies where ROS does not look: mv {place} {workspace()}"
        return (f"{place / 'package.xml'} names another package: write <name>{name}</name> there, "
                f"and project({name}) in CMakeLists.txt")
    for place in workspace() / name, workspace() / "scenarios" / name:
        if name and place.is_dir():
            return incomplete(place, "package.xml", source)
    return f"There is no package {package} in {workspace()}: {source}"


def built(package):
    """Whether catkin_make has seen the package."""
    prefixes = os.environ.get("CMAKE_PREFIX_PATH", "").split(":")
    if any(Path(prefix, "share", package, "cmake").exists() for prefix in prefixes):
        return None
    return f"{package} is not built: ./morbot setup"


def depends(package, *names):
    """Whether package.xml names these packages as dependencies."""
    file = folder(package) / "package.xml"
    sentence = unreadable(file)
    if sentence:
        return sentence
    known = {dependency.name for dependency in parse_package(str(file)).exec_depends}
    return next((f"{file} does not name {name}: add <exec_depend>{name}</exec_depend> before </package>"
                 for name in names if name not in known), None)


def scripts_start(package):
    """Whether the package has scripts, and all of them can be started."""
    scripts = folder(package) / "scripts"
    there = sorted(scripts.glob("[!.]*.py"))
    if not there:
        return f"There is no script in {scripts}: put one there, with a name that ends in .py"
    return next(filter(None, map(script_starts, there)), None)


def script_starts(path):
    """Whether the system can start the script."""
    if not path.is_file():
        return f"{path} is no file: remove it"
    try:
        first = path.read_bytes().partition(b"\n")[0].decode(errors="replace")
    except OSError as error:
        return f"{path} cannot be read: {error.strerror}"
    if not first.startswith("#!"):
        return f"{path.name} does not begin with #!/usr/bin/env python3: make that the first line of {path}"
    if first.endswith("\r"):
        return fr"{path.name} has line ends of Windows: sed -i 's/\r$//' {path}"
    if not starts_python(interpreter(first)):
        return f"{path.name} begins with {first}, which does not start ROS's Python: write #!/usr/bin/env python3"
    if not os.access(path, os.X_OK):
        return f"{path.name} is not executable: chmod +x {path}"
    return python_reads(path)


def interpreter(first):
    """The program that a script's first line names."""
    words = [word for word in first[len("#!"):].split() if not word.startswith("-")] or [""]
    return words[1] if words[0] in ("/usr/bin/env", "/bin/env") and len(words) > 1 else words[0]


def starts_python(program):
    """Whether the program is the Python for which ROS is installed."""
    return Path(shutil.which(program) or "").resolve().match("/usr/bin/python3*")


def python_reads(path):
    """Whether the script is Python."""
    try:
        with tokenize.open(path) as script:
            ast.parse(script.read())
    except SyntaxError as error:
        line = f"line {error.lineno} of " if error.lineno else ""
        return f"Python cannot read {line}{path.name}: {error.msg}"
    except ValueError as error:  # a zero byte, before Python 3.12
        return f"Python cannot read {path.name}: {error}"
    return None


def launch_file_includes_controller(package):
    """Whether one of the package's launch files includes the controller's, and passes its arguments on."""
    launch = folder(package) / "launch"
    there = sorted(launch.glob("*.launch"))
    if not there:
        return f"There is no launch file in {launch}: put one there, with a name that ends in .launch"
    sentences = [includes_controller(file) for file in there]
    return None if None in sentences else sentences[0]


def includes_controller(file):
    """Whether the launch file includes the controller's, and passes its arguments on."""
    try:
        includes = list(ET.parse(file).iter("include"))
    except (ET.ParseError, *ODD_XML) as error:
        return f"{file} is not XML: {error}"
    wanted = {"file": CONTROLLER_LAUNCH, "pass_all_args": "true"}
    if any(wanted.items() <= include.attrib.items() for include in includes):
        return None
    if any(include.get("file") == CONTROLLER_LAUNCH for include in includes):
        return f'{file} passes no arguments on to the controller: write pass_all_args="true" into its <include>'
    return (f"{file} does not include the controller: "
            f'add <include file="{CONTROLLER_LAUNCH}" pass_all_args="true"/> below <launch>')
