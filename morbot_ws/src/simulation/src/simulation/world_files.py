"""Worlds as YAML: those that this package ships, and files of users."""

import os
from typing import Dict, List, Tuple, Union

import yaml

from jetbot import InvalidValue, files
from jetbot.kinds import Kind, is_number
from jetbot.kinematics import Pose
from jetbot.text import enumeration

from .world import Polyline, World

SHIPPED = files.shipped(__file__, "simulation", "worlds")
MAX_POINTS = 1000  # of all walls and lines
MAX_PLACE = 1000   # m
MAX_DEPTH = 4      # a point is in a polyline, in a list of them, in the world


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
    except FileNotFoundError:
        raise InvalidValue(f"there is no world {file}", f"The simulation has {enumeration(names())}. "
                           "Name a file of your own by its whole path.") from None
    except (OSError, ValueError) as error:
        raise InvalidValue(f"the world {file} cannot be used: {getattr(error, 'strerror', None) or error}") from None
    return parse(content, f"the world {file}")


def parse(text: Union[str, bytes], source: str = "the world") -> World:
    """Return the world that is written in YAML, at its origin; raise InvalidValue, which names the source.

    Keys, all optional: ``walls``, ``lines`` (lists of polylines, each a list of [x, y] in m), ``line_width`` (m),
    ``origin`` ([x, y, yaw] in m and rad: where the rest is on the map).
    """
    try:
        values = _read(text)
        _check(values)
    except (yaml.YAMLError, ValueError, OverflowError) as error:
        raise InvalidValue(f"{source} cannot be used: {_reason(error)}") from None
    world = World(*(_polylines(values.get(name, [])) for name in ("walls", "lines")))
    if "line_width" in values:
        world = world._replace(line_width=float(values["line_width"]))
    return world.placed(Pose(*map(float, values.get("origin", Pose()))))


def dump(world: World) -> str:
    """Return the YAML of a world, for ``parse``."""
    return yaml.safe_dump({"walls": [[list(point) for point in polyline] for polyline in world.walls],
                           "lines": [[list(point) for point in polyline] for polyline in world.lines],
                           "line_width": world.line_width})


def _read(text: Union[str, bytes]) -> Dict[object, object]:
    """Return what YAML holds, by its keys; raise YAMLError, ValueError or OverflowError."""
    if len(text) > files.MAX_SIZE:
        raise ValueError(f"it is larger than {files.MAX_SIZE // 1024} kB")
    depth = 0
    for event in yaml.parse(text):  # before anything is made of it: a few lines can be a million points
        depth += isinstance(event, yaml.CollectionStartEvent) - isinstance(event, yaml.CollectionEndEvent)
        if isinstance(event, yaml.AliasEvent):
            raise ValueError("write each point out, without *")
        if depth > MAX_DEPTH:
            raise ValueError("there are too many [ around each other")
    values = yaml.safe_load(text)
    if not isinstance(values, dict):
        raise ValueError("it holds no walls: and no lines:")
    return values


def _check(values: Dict[object, object]) -> None:
    """Raise InvalidValue unless these are a world's."""
    for key, value in values.items():
        if key not in KEYS:
            raise InvalidValue(f"there is no {key}: in a world. The keys are {enumeration(list(KEYS))}")
        KEYS[key].check(key, value)
    polylines = [(f"polyline {number} of {key}", polyline) for key in ("walls", "lines")
                 for number, polyline in enumerate(values.get(key, []), 1)]
    for name, polyline in polylines:
        POLYLINE.check(name, polyline)
        for number, point in enumerate(polyline, 1):
            POINT.check(f"point {number} in {name}", point)
    if sum(len(polyline) for _, polyline in polylines) > MAX_POINTS:
        raise InvalidValue(f"its walls and lines have more than {MAX_POINTS} points")


def _reason(error: Exception) -> str:
    """Return in one phrase why a text is no world."""
    mark = getattr(error, "problem_mark", None)
    if mark:
        return f"line {mark.line + 1}: {error.problem}"
    return (getattr(error, "reason", None) or str(error)).partition("\n")[0].rstrip(".")


def _polylines(values: List[List[List[float]]]) -> Tuple[Polyline, ...]:
    """Return YAML's lists of points as polylines."""
    return tuple(tuple((float(x), float(y)) for x, y in polyline) for polyline in values)
