"""Which module ``jetbot`` Python imports: MorBot's has the name of NVIDIA's. It imports neither of them."""

import os
import sys
from importlib.machinery import PathFinder
from pathlib import Path
from typing import Dict, Iterable

OWN, NVIDIA, UNKNOWN = "MorBot's", "NVIDIA's", "another one"


def copies(path: Iterable[str]) -> Dict[str, str]:
    """Return whose each module ``jetbot`` on a path such as sys.path is, by its place; Python imports the first."""
    found = {}
    for entry in path:
        spec = PathFinder.find_spec("jetbot", [entry or os.getcwd()])
        if spec and spec.origin:
            file = Path(spec.origin).resolve()
            place = file.parent if file.name == "__init__.py" else file
            found[str(place)] = owner(place)
    return found


def owner(place: Path) -> str:
    """Return whose module this is, by its files. In a workspace's devel space it is one that catkin has written."""
    start = place / "__init__.py" if place.is_dir() else place
    if (place / "host.py").exists() or b"generated from catkin" in start.read_bytes():
        return OWN
    return NVIDIA if (place / "motor.py").exists() else UNKNOWN


def finding(path: Iterable[str]) -> str:
    """Return what is imported, and what else is there; "" if all are MorBot's."""
    found = copies(path)
    others = [f"{whose} is in {place}" for place, whose in found.items() if whose != OWN]
    if not others:
        return ""
    place, whose = next(iter(found.items()))
    return f"{whose} is imported, from {place}" + (f"; {', '.join(others)}" if whose == OWN else "")


def require_own() -> None:
    """End the process with one sentence if Python imports another module than MorBot's."""
    if next(iter(copies(sys.path).values()), OWN) != OWN:
        sys.exit(f"NOT jetbot: {finding(sys.path)}. Type: unset PYTHONPATH   and start this again in ./morbot shell.")
