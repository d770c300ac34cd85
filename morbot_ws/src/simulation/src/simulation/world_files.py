"""Worlds as YAML: those that this package ships, and files of users."""

import os
from typing import Dict, List, Tuple, Union

import yaml

from jetbot import InvalidValue, files
from jetbot.kinds import Kind, is_number
from jetbot.kinematics import Pose
from jetbot.text import enumeration

from .world import LINE_WIDTH, Polyline, World

SHIPPED = files.shipped(__file__, "simulation", "worlds")
MAX_POINTS = 1000  # of all walls and lines
MAX_PLACE = 1000   # m


def is_list_of(value: object, length: int) -> bool:
    """Return whether this is a list of so many coordinates."""
    return (isinstance(value, list) and len(value) == length
            and all(is_number(each) and abs(each) <= MAX_PLACE for each in value))


POINT = Kind(lambda value: is_list_of(value, 2), f"[x, y] in m, within {MAX_PLACE}")
POLYLINE = Kind(lambda value: isinstance(value, list) and len(value) >= 2, "a list of two points [x, y] or more")
POLYLINES = Kind(lambda value: isinstance(value, list), "a list of polylines, each a list of points [x, y]")
KEYS = {
    "walls": POLYLINES,
    "lines": POLYLINES,
    "line_width": Kind(lambda value: is_number(value) and 0 < value <= 1, "a number of metres above 0, 1 at most"),
    "origin": Kind(lambda value: is_list_of(value, 3), f"[x, y, yaw] in m and rad, within {MAX_PLACE}"),
}


def names() -> List[str]:
    """Return the names of the worlds that this package ships."""
    return sorted(file.name for file in SHIPPED.glob("*.yaml"))


def load(name: str) -> World:
    """Return the world of this package with this name, such as arena.yaml, else that in a file; raise InvalidValue."""
    file = SHIPPED / name if name in names() else os.path.abspath(os.path.expanduser(name))
    try:
        content = files.read(file)
    except (OSError, ValueError) as error:
        raise InvalidValue(f"the world {file} cannot be used: {getattr(error, 'strerror', None) or error}",
                           f"The simulation has {enumeration(names())}. Name a file of your own by its whole path."
                           ) from None
    return parse(content, f"the world {file}")


def parse(text: Union[str, bytes], source: str = "the world") -> World:
    """Return the world that is written in YAML, at its origin; raise InvalidValue, which names the source.

    Keys, all optional: ``walls``, ``lines`` (lists of polylines, each a list of [x, y] in m), ``line_width`` (m),
    ``origin`` ([x, y, yaw] in m and rad: where the rest is on the map).
    """
    try:
        values = _read(text)
        world = World(_polylines(values, "walls"), _polylines(values, "lines"),
                      float(values.get("line_width", LINE_WIDTH)))
        if sum(map(len, world.walls + world.lines)) > MAX_POINTS:
            raise InvalidValue(f"its walls and lines have more than {MAX_POINTS} points")
    except (yaml.YAMLError, ValueError, OverflowError, RecursionError) as error:
        raise InvalidValue(f"{source} cannot be used: {_reason(error)}") from None
    return world.placed(Pose(*map(float, values.get("origin", Pose()))))


def dump(world: World) -> str:
    """Return the YAML of a world, for ``parse``."""
    return yaml.safe_dump({"walls": [[list(point) for point in polyline] for polyline in world.walls],
                           "lines": [[list(point) for point in polyline] for polyline in world.lines],
                           "line_width": world.line_width})


def _read(text: Union[str, bytes]) -> Dict[str, object]:
    """Return a world's values by their keys; raise YAMLError, ValueError, OverflowError or RecursionError."""
    if len(text) > files.MAX_SIZE:
        raise ValueError(f"it is larger than {files.MAX_SIZE // 1024} kB")
    values = yaml.safe_load(text)
    if any(isinstance(token, yaml.AliasToken) for token in yaml.scan(text)):  # a few lines can be a million points
        raise ValueError("write each point out, without *")
    if not isinstance(values, dict):
        raise ValueError("it holds no walls: and no lines:")
    for key, value in values.items():
        if key not in KEYS:
            raise InvalidValue(f"there is no {key}: in a world. The keys are {enumeration(list(KEYS))}")
        KEYS[key].check(key, value)
    return values


def _polylines(values: Dict[str, object], key: str) -> Tuple[Polyline, ...]:
    """Return the polylines under a key; raise InvalidValue."""
    polylines = values.get(key, [])
    for number, polyline in enumerate(polylines, 1):
        name = f"polyline {number} of {key}"
        POLYLINE.check(name, polyline)
        for index, point in enumerate(polyline, 1):
            POINT.check(f"point {index} in {name}", point)
    return tuple(tuple((float(x), float(y)) for x, y in polyline) for polyline in polylines)


def _reason(error: Exception) -> str:
    """Return in one phrase why a text is no world."""
    mark = getattr(error, "problem_mark", None)
    if mark:
        return f"line {mark.line + 1}: {error.problem}"
    return (getattr(error, "reason", None) or str(error)).partition("\n")[0].rstrip(".")
