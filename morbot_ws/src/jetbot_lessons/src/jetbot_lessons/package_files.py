"""Checks of what is in a package: package.xml, scripts, launch files, the recorded drive. Nothing is executed."""

import ast
import os
import shutil
from pathlib import Path
from shlex import quote

from driving_tasks.report.marks import SIMULATOR
from driving_tasks.scoring.tasks import TASKS
from jetbot.files import read

from . import Problem
from .packages import MANIFEST, MAX_ENTRIES, NameOrFolder, folder, parse, read_xml

CONTROLLER_LAUNCH = "$(find jetbot_control_node)/launch/jetbot_controller.launch"
SHEBANG = "#!/usr/bin/env python3"
MAX_SCRIPT = 1024 * 1024  # bytes
NEEDED = {"metre": 60.0, "camera": 60.0, "roam": 25.0}  # points of 100, by the task's name


def check_handed_in(place: Path) -> Problem:
    """Return the problem, or None if the package's folder is complete and small, and no link leads out of it."""
    home, count = place.resolve(), 0
    for parent, folders, names in os.walk(place):
        for path in (Path(parent, name) for name in sorted(folders + names)):
            count += 1
            if count > MAX_ENTRIES:
                return f"{place} has more than {MAX_ENTRIES:,} files: hand in the package alone"
            if path.is_symlink() and home not in Path(os.path.realpath(path)).parents:
                return f"{path} is a link that leads out of the package: hand in the file itself"
    if not (place / "CMakeLists.txt").is_file():
        return f"There is no CMakeLists.txt in {place}: hand in the whole package"
    return None


def check_depends(package: NameOrFolder, *names: str) -> Problem:
    """Return the problem, or None if package.xml names these packages as dependencies."""
    file = folder(package) / MANIFEST
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
    except (SyntaxError, ValueError) as error:  # ValueError: a zero byte, before 3.12
        return f"Python cannot read {name}: {error}"
    except (RecursionError, MemoryError):
        return f"Python cannot read {name}: it is nested too deeply"
    if not program.body:
        return f"{name} holds no command yet: write your program into it, and save it"
    return None


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
    except Exception as error:  # of a parser
        return f"{file} is not XML: {error}"
    if not passing:
        return (f"{file} does not include the controller: "
                f'add <include file="{CONTROLLER_LAUNCH}" pass_all_args="true"/> below <launch>')
    if "true" not in passing:
        return f'{file} does not pass its arguments on to the controller: write pass_all_args="true" in its <include>'
    return None


def check_drive(package: NameOrFolder, task: str) -> Problem:
    """Return the problem, or None if the bag in the package is a drive with the points that this task NEEDED."""
    bag = folder(package) / f"{task}.bag"
    record = f"rosrun driving_tasks judge.py {task} --record {bag}"
    if not bag.is_file():
        return f"There is no file {bag}: record your drive with {record}"
    from driving_tasks.sources.bags import judge_bag  # here: rosbag takes long to import
    mark = judge_bag(TASKS[task], str(bag))
    if not mark.result:
        return f"{bag} has no score: {mark.problem}"
    if mark.source and not mark.source.startswith(SIMULATOR):
        return f"{bag} is not what the simulator has measured ({mark.source}): record your drive with {record}"
    score = round(mark.result.score, 1)
    if score >= NEEDED[task]:
        return None
    return (f"{bag.name} has {score:.1f} of 100 points, and {NEEDED[task]:.0f} are needed: "
            f"it {mark.result.largest_loss}; improve your program, and record it again")
