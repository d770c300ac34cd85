"""The table of the lessons: what each checks, in this order."""

from functools import partial
from typing import Callable, Dict, List

from . import Problem, files, graph, master, motion
from .motion import TOPIC

FIRST_OWN, LAST = 7, 8  # the lessons about the pupil's own package
ROBOT, SCENARIO, KEYBOARD = "jetbot_control_node", "workshop", "teleop_twist_keyboard"
RUN = f"rosrun {ROBOT} jetbot_controller.py _i2c_bus:=fake"
LAUNCH = f"roslaunch {ROBOT} jetbot_controller.launch i2c_bus:=fake"
LAUNCH_SCENARIO = f"roslaunch {SCENARIO} workshop_jetbot_controller.launch i2c_bus:=fake"
IN_A_LOOP = "publish in a loop, with rate = rospy.Rate(10) and rate.sleep()"

Checks = List[Callable[[], Problem]]


def package(name: str, *dependencies: str) -> Checks:
    """Return the checks of a package that drives the robot."""
    return [partial(files.check_exists, name, "create it with catkin_create_pkg, as in lesson 7"),
            partial(files.check_depends, name, "rospy", "geometry_msgs", *dependencies),
            partial(files.check_scripts, name),
            partial(files.check_built, name)]


def own_package(name: str, *dependencies: str) -> Checks:
    """Return the checks of the package that the pupil has made."""
    exists, *others = package(name, *dependencies)
    return [exists, partial(files.check_own, name), *others]


def controller(start: str, start_master: str = "") -> Checks:
    """Return the checks of the running controller; start: what starts it, and the master if nothing else does."""
    return [partial(master.check_master, start_master or start),
            partial(graph.check_node, "/jetbot_controller", start),
            partial(graph.check_subscribes, "/jetbot_controller", TOPIC),
            partial(graph.check_type, TOPIC, "geometry_msgs/Twist")]


def drives(name: str, start: str, fix: str = IN_A_LOOP) -> Checks:
    """Return the checks of a running scenario; start: what starts it, fix: what brings it to 10 commands a second."""
    return [partial(graph.check_publishes, name, TOPIC, start),
            partial(graph.check_no_other_publisher, TOPIC, name),
            partial(motion.check_rate, name, 10, fix),
            motion.check_wheels_turn]


def lessons(own: str) -> Dict[int, Checks]:
    """Return the checks of each lesson by its number; own: the name of the pupil's package."""
    run_own = f"rosrun {own}, and the name of your script"
    launch_own = f"roslaunch {own}, the name of your launch file and, without a robot, i2c_bus:=fake"
    return {
        1: package(ROBOT) + package(SCENARIO, ROBOT),
        2: controller(RUN, "roscore"),
        3: [*controller(RUN, "roscore"), partial(graph.check_no_other_publisher, TOPIC), motion.check_wheels_obey],
        4: [partial(files.check_exists, KEYBOARD, "get it with git clone and ./morbot setup, as in lesson 4"),
            *controller(RUN, "roscore"),
            partial(graph.check_node, f"/{KEYBOARD}", f"rosrun {KEYBOARD} {KEYBOARD}.py"),
            partial(motion.check_key, f"/{KEYBOARD}")],
        5: [*controller(LAUNCH), partial(graph.check_launched_together, ROBOT)],
        6: [*controller(LAUNCH_SCENARIO), partial(graph.check_launched_together, ROBOT, SCENARIO),
            *drives(SCENARIO, LAUNCH_SCENARIO, "start it without rate:=")],
        7: [*own_package(own), *controller(LAUNCH), *drives(own, run_own)],
        8: [*own_package(own, ROBOT), partial(files.check_launch_files, own), *controller(launch_own),
            partial(graph.check_launched_together, ROBOT, own), *drives(own, launch_own)],
    }


def first_problem(lesson: int, own: str = "") -> Problem:
    """Return the first problem of a lesson, or None if it is done; own: the name of the pupil's package."""
    return next(filter(None, (check() for check in lessons(own)[lesson])), None)
