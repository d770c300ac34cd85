"""The classes with robots on this computer."""

import shutil
from pathlib import Path
from typing import List

from jetbot import InvalidValue
from jetbot.text import enumeration, printable
from jetbot_cockpit.classroom.place import CLASS_NAME, FOLDER
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.remote.key import ROBOT_NAME
from jetbot_cockpit.web.access import numbered


def classes(folder: str) -> List[str]:
    """Return their names."""
    return sorted(file.parent.name for file in Path(folder).expanduser().glob("*/fleet.json"))


def open_class(name: str, new: bool, folder: str = FOLDER) -> Fleet:
    """Return a class. name: "" for the only one; new: whether it may be made now. Raise InvalidValue."""
    known = classes(folder)
    if not name and len(known) != 1:
        there = f"has {enumeration(known)}" if known else "has none yet"
        raise InvalidValue(f"the class is missing; this computer {there}", "As in ./morbot fleet --class 7b.")
    name = name or known[0]
    if not name or not CLASS_NAME.accepts(name):
        raise InvalidValue(f"no class can be called {printable(name)}: {CLASS_NAME.description}")
    if not new and name not in known:
        raise InvalidValue(f"there is no class {name} on this computer",
                           f"This makes it: ./morbot fleet --class {name} add HOST")
    return Fleet(folder, name)


def entry_of(fleet: Fleet, name: str) -> Entry:
    """Return a robot of the list. Raise InvalidValue."""
    found = [entry for entry in fleet.robots if entry.name == name]
    if not found:
        names = enumeration([entry.name for entry in fleet.robots]) if fleet.robots else "none"
        raise InvalidValue(f"there is no robot {printable(name)} in the class {fleet.name}, which has {names}")
    return found[0]


def check_name(name: str) -> None:
    """Raise InvalidValue if no robot can be called so."""
    if not ROBOT_NAME.fullmatch(name):
        raise InvalidValue(f"no robot can be called {printable(name)}",
                           "A letter, then letters, digits and _, 30 at most.")


def unused_name(fleet: Fleet) -> str:
    """Return the first of jetbot_01, jetbot_02, ... that no robot of the list has."""
    names = {entry.name for entry in fleet.robots}
    return next(name for name in numbered(len(names) + 1) if name not in names)


def enlist(fleet: Fleet, entry: Entry) -> None:
    """Add a robot to the list, or change it there; it has one name. Raises OSError."""
    fleet.update()  # another ./morbot fleet may have changed it
    others = [each for each in fleet.robots if each.name != entry.name and each.login != (entry.login or None)]
    fleet.save(sorted([*others, entry]))
    fleet.update()


def strike(fleet: Fleet, name: str) -> None:
    """Take a robot from the list; its key is void. Raises OSError."""
    fleet.update()
    fleet.save([each for each in fleet.robots if each.name != name],
               {**fleet.removed, name: fleet.removed.get(name, 0) + 1})
    fleet.update()


def delete(fleet: Fleet) -> None:
    """Delete all that this computer keeps of a class, its key too. Raises OSError."""
    shutil.rmtree(fleet.path.parent)
