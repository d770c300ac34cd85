"""What other programs report about a robot, made fit for a page: numbers, tasks and drawings. No ROS here."""

import math
from contextlib import suppress
from typing import Any, Callable, Iterable, Mapping, Optional, Sequence, Tuple

from jetbot.health import READINGS, Health, judge
from jetbot.kinematics import FULL_SPEED, WHEEL_SEPARATION, Pose, from_frame
from jetbot.sentence import load
from jetbot.text import printable
from jetbot_ros.contract import MAX_NAME

from ..session.snapshot import Shape, TaskSnapshot, label

CLOSED_LOOP = WHEEL_SEPARATION, FULL_SPEED  # of a JetBot Pro, which limits its wheels itself
DRIVING, DONE = "driving", "done"
STATES = ("ready", DRIVING, DONE, "cancelled")  # of a task
MAX_TITLE = 60      # characters
MAX_TEXT = 200      # characters
MAX_SECONDS = 1e5
MAX_LOST = 1e4      # points: each contact with a wall costs 20
GONE_AFTER = 3.0    # s without a publisher until a task without a score is forgotten: its judge was killed
SILENT_AFTER = 5.0  # s without a message until a drive is forgotten: its judge is frozen
ARROW, LINE_STRIP, ADD = 0, 4, 0       # types and action of a visualization_msgs/Marker
KINDS = {("walls", LINE_STRIP): "wall", ("lines", LINE_STRIP): "line",
         ("course", LINE_STRIP): "course", ("goal", ARROW): "goal"}  # by a marker's namespace and type
GOAL_LENGTH = 0.1   # m of the arrow that shows a goal's heading
MAX_POINTS = 1000   # of a topic; a shape that exceeds them is not drawn
MAX_DISTANCE = 1e4  # m from the map's origin
MAX_WIDTH = 1.0     # m


def rounded(values: Sequence[float]) -> Optional[Tuple[float, ...]]:
    """Return the values with three decimals and without -0.0, or None if one is not finite."""
    return tuple(round(value, 3) + 0.0 for value in values) if all(map(math.isfinite, values)) else None


def yaw_of(rotation: Any) -> float:
    """Return the angle in rad of a rotation about the z axis, a geometry_msgs/Quaternion."""
    return 2 * math.atan2(rotation.z, rotation.w)


def program(commanded_by: Optional[str], cockpit: str) -> str:
    """Return the name of the program whose command a robot drives, by its diagnostics; "" if it is the cockpit."""
    named = commanded_by and commanded_by.startswith("/") and commanded_by != cockpit
    return label(commanded_by) if named else ""


def geometry(wheel_separation: Optional[str], max_speed: Optional[str]) -> Optional[Tuple[float, float]]:
    """Return what a controller's diagnostics say, "" of a board that takes a Twist unchanged; None if they do not."""
    if wheel_separation == max_speed == "":
        return CLOSED_LOOP
    try:
        values = float(wheel_separation), float(max_speed)
    except (TypeError, ValueError):
        return None
    return values if all(math.isfinite(value) and value > 0 for value in values) else None


def health(values: Mapping[str, str]) -> Tuple[Health, ...]:
    """Return what there is to say of a robot's readings, as its controller's diagnostics have them."""
    readings = {}
    for name in READINGS.keys() & values.keys():
        with suppress(ValueError):
            readings[name] = float(values[name])
    return tuple(judge(readings))


def decode_task(name: str, text: str, values: Mapping[str, str]) -> Optional[TaskSnapshot]:
    """Return the task that a judge's DiagnosticStatus reports, with its values by key; None if it is no task's."""
    state = values.get("state")
    if not name or state not in STATES:
        return None
    score = number(values.get("score"), 100.0) if state == DONE else None
    return TaskSnapshot(printable(name)[:MAX_TITLE], printable(values.get("title") or name)[:MAX_TITLE], state,
                printable(text)[:MAX_TEXT], number(values.get("seconds"), MAX_SECONDS), score,
                printable(values.get("driver", ""))[:MAX_NAME], printable(values.get("request", ""))[:MAX_TITLE],
                load(values.get("sentences", "")) or (), number(values.get("lost"), MAX_LOST))


def number(text: Optional[str], largest: float) -> Optional[float]:
    """Return the number, with one decimal; None if the text is no number from 0 to the largest."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return None
    return round(value, 1) + 0.0 if 0 <= value <= largest else None


class TaskTracker:
    """Decides how long a robot's task is shown. Times are monotonic seconds."""

    def __init__(self):
        self._task: Optional[TaskSnapshot] = None
        self._over: Optional[TaskSnapshot] = None  # one whose judge is gone
        self._updated_at = self._connected_at = -math.inf

    def update(self, task: Optional[TaskSnapshot], now: float) -> None:
        """Take what a judge has reported; any thread may call it."""
        self._updated_at = self._connected_at = now
        self._task = task

    def current(self, connected: bool, now: float) -> Optional[TaskSnapshot]:
        """Return the task that is shown now, or None. connected: whether a judge publishes."""
        task = self._task
        if connected:
            self._connected_at = now
        if task and task.state != DONE:
            gone = now - self._connected_at > GONE_AFTER
            silent = task.state == DRIVING and now - self._updated_at > SILENT_AFTER
            if gone or silent:
                self._over = task
        return None if task is self._over else task


def decode_shapes(markers: Iterable[Any], on_map: Callable[[str, Pose], Pose]) -> Tuple[Shape, ...]:
    """Return what the markers of a visualization_msgs/MarkerArray draw. on_map: puts a pose of a frame on the map.

    Markers of other kinds, with numbers that no map shows, or beyond MAX_POINTS are left out.
    """
    shapes, room = [], MAX_POINTS
    for marker in markers:
        kind = KINDS.get((marker.ns, marker.type)) if marker.action == ADD else None
        shape = _decode_shape(kind, marker, on_map) if kind and len(marker.points) <= room else None
        if shape and len(shape.points) <= room:
            shapes.append(shape)
            room -= len(shape.points)
    return tuple(shapes)


def _decode_shape(kind: str, marker: Any, on_map: Callable[[str, Pose], Pose]) -> Optional[Shape]:
    """Return what one marker draws, or None if that cannot be drawn."""
    position = marker.pose.position
    origin = on_map(marker.header.frame_id, Pose(position.x, position.y, yaw_of(marker.pose.orientation)))
    if not _is_drawable((*origin, marker.scale.x)):
        return None
    points = [(0.0, 0.0), (GOAL_LENGTH, 0.0)] if kind == "goal" else [(each.x, each.y) for each in marker.points]
    placed = [from_frame(origin, point) for point in points]
    if len(placed) < 2 or not all(map(_is_drawable, placed)):
        return None
    return Shape(kind, round(min(max(marker.scale.x, 0.0), MAX_WIDTH), 3), tuple(map(rounded, placed)))


def _is_drawable(values: Iterable[float]) -> bool:
    """Return whether these are numbers that a map shows: finite, and not too large."""
    return all(abs(value) <= MAX_DISTANCE for value in values)
