"""What is drawn on the map around a robot: its world's walls and lines, its task's course and goal. No ROS here."""

import math
from typing import Any, Callable, Dict, Iterable, List, NamedTuple, Optional, Tuple

from jetbot import kinematics
from jetbot.kinematics import from_frame

Point = Tuple[float, float]            # x, y in m on the map
Pose = Tuple[float, float, float]      # x, y in m, yaw in rad
Place = Callable[[str, Pose], Pose]    # from a frame to the map

ARROW, LINE_STRIP, ADD = 0, 4, 0       # types and action of a visualization_msgs/Marker
KINDS = {("walls", LINE_STRIP): "wall", ("lines", LINE_STRIP): "line",
         ("course", LINE_STRIP): "course", ("goal", ARROW): "goal"}  # by a marker's namespace and type
GOAL_LENGTH = 0.1   # m of the arrow that shows a goal's heading
MAX_POINTS = 1000   # of a topic; a shape that exceeds them is not drawn
MAX_DISTANCE = 1e4  # m from the map's origin
MAX_WIDTH = 1.0     # m


class Shape(NamedTuple):
    """A polyline on the map; a goal is an arrow that begins there. kind: a value of KINDS; width: of the line in m."""

    kind: str
    width: float
    points: Tuple[Point, ...]


def decode(markers: Iterable[Any], on_map: Place) -> Tuple[Shape, ...]:
    """Return what the markers of a visualization_msgs/MarkerArray draw. on_map: puts a pose of a frame on the map.

    Markers of other kinds, with numbers that no map shows, or beyond MAX_POINTS are left out.
    """
    shapes, room = [], MAX_POINTS
    for marker in markers:
        kind = KINDS.get((marker.ns, marker.type)) if marker.action == ADD else None
        shape = decode_marker(kind, marker, on_map) if kind and len(marker.points) <= room else None
        if shape and len(shape.points) <= room:
            shapes.append(shape)
            room -= len(shape.points)
    return tuple(shapes)


def decode_marker(kind: str, marker: Any, on_map: Place) -> Optional[Shape]:
    """Return what one marker draws, or None if that cannot be drawn."""
    position, rotation = marker.pose.position, marker.pose.orientation
    own = position.x, position.y, 2 * math.atan2(rotation.z, rotation.w)
    x0, y0, yaw = on_map(marker.header.frame_id, own)
    if not is_drawable((x0, y0, yaw, marker.scale.x)):
        return None
    points = [(0.0, 0.0), (GOAL_LENGTH, 0.0)] if kind == "goal" else [(each.x, each.y) for each in marker.points]
    placed = [from_frame(kinematics.Pose(x0, y0, yaw), point) for point in points]
    if len(placed) < 2 or not all(map(is_drawable, placed)):
        return None
    width = min(max(marker.scale.x, 0.0), MAX_WIDTH)
    return Shape(kind, round(width, 3), tuple((round(x, 3) + 0.0, round(y, 3) + 0.0) for x, y in placed))


def is_drawable(values: Iterable[float]) -> bool:
    """Return whether these are numbers that a map shows: finite, and not too large."""
    return all(abs(value) <= MAX_DISTANCE for value in values)


class Scenes:
    """What is drawn around all robots, as messages of the cockpit's socket."""

    def __init__(self):
        self._scenes: Dict[str, Tuple[Shape, ...]] = {}

    def update(self, scenes: Dict[str, Tuple[Shape, ...]]) -> List[dict]:
        """Take the shapes of all robots; return a message for each robot whose shapes have changed."""
        before, self._scenes = self._scenes, scenes
        return [message(robot, shapes) for robot, shapes in scenes.items() if shapes != before.get(robot, ())]

    def messages(self) -> List[dict]:
        """Return a message for each robot, also without shapes: a page may have missed that they are gone."""
        return [message(robot, shapes) for robot, shapes in self._scenes.items()]


def message(robot: str, shapes: Iterable[Shape]) -> dict:
    """Return the message "scene" of the socket."""
    return {"type": "scene", "robot": robot, "shapes": [shape._asdict() for shape in shapes]}
