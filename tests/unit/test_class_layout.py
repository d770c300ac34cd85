"""Where the robots of a class start: no task leads one to another's start or course; in a world they fit in."""

import math
import xml.etree.ElementTree as ET

from conftest import PACKAGES
from driving_tasks.scoring.tasks import TASKS
from jetbot.kinematics import Pose
from simulation.world import RADIUS
from simulation.world_files import load

LAUNCH = ET.parse(PACKAGES / "jetbot_class/launch/simulated_robots.launch").getroot()
EXPRESSIONS = [LAUNCH.find(f"include/arg[@name='{axis}']").get("value")[len("$(eval "):-1] for axis in "xy"]


def start(robot, world=""):
    """Return where the robot with this number starts, as roslaunch evaluates it."""
    return tuple(eval(expression, {"robots": robot, "world": world}) for expression in EXPRESSIONS)


def test_all_robots_of_a_class_can_drive_all_tasks_at_the_same_time_and_touch_none():
    places = {(round(x, 1), round(y, 1)) for task in TASKS.values() for x, y in task.course.points}
    starts = [start(robot) for robot in range(1, 31)]
    offsets = {(x - start_x, y - start_y) for x, y in starts for start_x, start_y in starts} - {(0, 0)}
    rounded_by = 0.1 * math.sqrt(2) / 2  # m, at most
    for x, y in (offset for offset in offsets if math.hypot(*offset) < 6):
        nearest = min(math.dist(place, (other_x + x, other_y + y)) for place in places for other_x, other_y in places)
        assert nearest - 2 * rounded_by > 2 * RADIUS, (x, y)


def test_the_robots_of_a_class_are_free_in_the_arena():
    arena = load("arena.yaml")
    assert min(arena.clearance(Pose(*start(robot, "arena.yaml"), 0.0)) for robot in range(1, 16)) > 0.3
