"""Finds a mistyped launch argument: roslaunch ignores a name that no launch file takes. Quick to import."""

import os
import re
from functools import lru_cache
from typing import Iterable, Iterator, List, NamedTuple, Optional, Sequence, Set, Tuple
from xml.parsers import expat

from jetbot.text import closest

SOURCE = os.path.abspath(f"{__file__}/../../..")
MAX_SIZE = 1024 * 1024  # bytes of a launch file
MAX_FILES = 100
UNREADABLE = (OSError, ValueError, LookupError, expat.ExpatError)  # of a file that hides its names, or that is broken


class LaunchFile(NamedTuple):
    """What a launch file holds.

    mentioned: the names in its substitutions; full_includes: the files that get all arguments; other_includes: the
    others, as they are written.
    """

    arguments: Set[str]
    mentioned: Set[str]
    full_includes: List[str]
    other_includes: List[str]


def argument_problem(words: Sequence[str], typed: Sequence[Tuple[str, str]]) -> Optional[str]:
    """Return the problem with the first mistyped argument, or None; also None where the names cannot be known.

    words: PACKAGE FILE or FILE, as on roslaunch's command line; typed: [(name, value)].
    """
    typed = [(name, value) for name, value in typed if not name.startswith("__")]  # __ns:= and the like are ROS's
    if not (words and typed):
        return None
    known, mentioned = set(), set()
    try:
        files = launch_files(words)
        for each in receivers(files):
            known |= each.arguments
            mentioned |= each.mentioned
            if known.issuperset(name for name, _ in typed):
                return None
        for name, value in typed:
            if name not in known | mentioned and (not name.startswith("_") or name.strip("_") in known):
                return f"morbot: {_explain(name, value, known, files)}"
    except UNREADABLE:
        pass
    return None


def _explain(name, value, known, files):
    for file in files:
        if any(_takes(name, include, file) for include in read_launch_file(file).other_includes):
            return (f"{os.path.basename(file)} does not pass the argument {name} on. "
                    'Add pass_all_args="true" to its <include>.')
    meant = closest(name, known)
    advice = f"Did you mean {meant}:={value}?" if meant else f"The arguments are {', '.join(sorted(known))}."
    return f"there is no argument {name}. {advice}"


def _takes(name, include, file):
    try:
        return any(name in each.arguments for each in receivers([substitute(include, file)]))
    except UNREADABLE:
        return False


def launch_files(words: Sequence[str]) -> List[str]:
    """Return the files that roslaunch reads: of PACKAGE FILE, that file of the package; else the words themselves."""
    folder = package_folder(words[0]) if len(words) > 1 else ""
    for place, _, names in os.walk(folder, followlinks=True):
        if words[1] in names:
            return [os.path.join(place, words[1]), *words[2:]]
    return list(words)


@lru_cache(maxsize=None)
def package_folder(name: str) -> str:
    """Return the folder of a package, "" if there is none."""
    if name == "jetbot_control_node" and os.path.exists(f"{SOURCE}/package.xml"):  # not where it is installed
        return SOURCE
    import rospkg  # here: it takes longer than all the rest, and thirty robots start thirty times
    try:
        return rospkg.RosPack().get_path(name)
    except rospkg.ResourceNotFound:
        return ""


def receivers(files: Iterable[str]) -> Iterator[LaunchFile]:
    """Yield these launch files, and all that get their arguments; raise UNREADABLE."""
    queue = list(files)
    for file in queue:
        launch_file = read_launch_file(file)
        yield launch_file
        queue += [each for each in launch_file.full_includes if each not in queue]
        if len(queue) > MAX_FILES:
            raise ValueError(f"more than {MAX_FILES} launch files")


def read_launch_file(file: str) -> LaunchFile:
    """Return what a launch file holds; raise UNREADABLE."""
    if not os.path.isfile(file) or os.path.getsize(file) > MAX_SIZE:
        raise ValueError(f"{file} is no launch file")
    with open(file, "rb") as stream:
        text = stream.read(MAX_SIZE)
    found, inside = LaunchFile(set(), set(), [], []), []

    def start(tag, attributes):
        inside.append(tag)
        for substitution in re.findall(r"\$\((?:arg|eval) .*", " ".join(attributes.values())):
            found.mentioned.update(re.findall(r"\w+", substitution))
        if tag == "arg" and "include" not in inside:
            found.arguments.add(attributes["name"])
        elif tag == "include":
            passes = substitute(attributes.get("pass_all_args", ""), file).lower() in ("true", "1")
            if passes:
                found.full_includes.append(substitute(attributes["file"], file))
            else:
                found.other_includes.append(attributes["file"])

    parser = expat.ParserCreate()
    parser.StartElementHandler, parser.EndElementHandler = start, lambda tag: inside.pop()
    parser.Parse(text, True)
    return found


def substitute(text: str, file: str) -> str:
    """Return a text of a launch file with $(find ...), $(dirname) and $(env ...) replaced; raise UNREADABLE."""
    def value(match):
        command, *rest = match[1].split()
        if command == "dirname":
            return os.path.dirname(os.path.abspath(file))
        if command == "find" and package_folder(rest[0]):
            return package_folder(rest[0])
        if command in ("env", "optenv"):
            return os.environ[rest[0]]
        raise ValueError(f"{match[0]} is not known before the launch")
    return re.sub(r"\$\(([^()]*)\)?", value, text)
