"""Checks of what a pupil has written down."""

from pathlib import Path
from typing import Dict, Iterator, List

from jetbot.files import read

from . import Problem
from .packages import MANIFEST, folder, parse, workspace

ANSWER = "lesson_1.txt"


def check_needed(package: str) -> Problem:
    """Return the problem, or None if ANSWER, here or in the project's folder, names what the package needs to run."""
    task = f"write into it which packages {package} needs when it runs, one per line"
    places = [Path.cwd(), workspace().parent.parent]
    file = next((place / ANSWER for place in places if (place / ANSWER).exists()), None)
    if not file:
        return f"There is no file {ANSWER} in {places[0]}: make it, and {task}"
    try:
        text = read(file).decode("utf-8-sig", errors="replace")
    except OSError as error:
        return f"{file} cannot be read: {error.strerror}"
    names = text.replace(",", " ").split()
    if not names:
        return f"{file} is empty: {task}, and save it"
    if "<" in text:
        return f"{file} has lines of package.xml: write the names alone, without <exec_depend>"
    return next(_problems(package, file, names), None)


def _problems(package: str, file: Path, names: List[str]) -> Iterator[str]:
    """Yield what is wrong with these names of packages."""
    manifest = folder(package) / MANIFEST
    needed, others = _dependencies(manifest)
    for name in names:
        if name in others and name not in needed:
            yield f"{package} needs {name} {others[name]}, not when it runs: remove {name} from {file}"
        elif name not in needed:
            yield f"{file} names {name}, and {manifest} does not: correct or remove it"
    given = len(needed & set(names))
    if given < len(needed):
        yield (f"{file} names {given} of the {len(needed)} packages that {package} needs when it runs: "
               f"add each exec_depend of {manifest}")


def _dependencies(manifest: Path):
    """Return the names of the packages needed to run, and {name: for what} of those needed otherwise."""
    described = parse(manifest)
    others: Dict[str, str] = {each.name: "to be tested" for each in described.test_depends}
    others.update((each.name, "to be built") for each in described.build_depends + described.buildtool_depends)
    return {each.name for each in described.exec_depends}, others
