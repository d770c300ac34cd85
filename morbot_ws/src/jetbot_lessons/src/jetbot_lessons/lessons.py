"""What each lesson checks, in this order."""

from functools import partial
from pathlib import Path
from typing import Callable, Dict, List

from catkin_pkg.package import InvalidPackage

from driving_tasks import contained
from jetbot_ros import contract

from . import Problem, answers, graph, motion, package_files, packages, sight
from .packages import NameOrFolder

FIRST_OWN = 7  # lesson about the pupil's own package
WITH_ROBOT = range(2, FIRST_OWN)  # the lessons about a robot that runs
CONTROLLER, SCENARIO, KEYBOARD = "jetbot_control_node", "workshop", "teleop_twist_keyboard"
RUN = f"rosrun {CONTROLLER} jetbot_controller.py _i2c_bus:=fake"
LAUNCH = f"roslaunch {CONTROLLER} jetbot_controller.launch i2c_bus:=fake"
LAUNCH_SCENARIO = f"roslaunch {SCENARIO} workshop_jetbot_controller.launch i2c_bus:=fake"
SIMULATE = "roslaunch simulation simulation.launch world:=line.yaml"
SEES = "sensor_msgs", "std_msgs"  # what a package needs that looks at pictures
IN_A_LOOP = "publish in a loop, with rate = rospy.Rate(10) and rate.sleep()"
GET_KEYBOARD = "get it with git clone and ./morbot setup, as in lesson 4"
EXERCISE = "in another terminal, start the exercise's rostopic pub -r 10, and leave it running"

LIMITS = contained.Limits(memory=1000, cpu_time=10, wall_time=30)  # of a check of files that others wrote

Checks = List[Callable[[], Problem]]


def limited(check: Callable[..., Problem], package: object, *arguments: object) -> Callable[[], Problem]:
    """Return a function that returns the check's problem, or why the check did not end: it runs in a child process."""
    def run():
        outcome = contained.run(described, check, package, *arguments, limits=LIMITS)
        return f"The files of {package} cannot be checked: {outcome.problem}" if outcome.problem else outcome.value
    return run


def described(check: Callable[..., Problem], *arguments: object) -> Problem:
    """Return the problem that a check finds, also where it cannot read the package."""
    try:
        return check(*arguments)
    except InvalidPackage as error:
        return str(error)


def contents(package: NameOrFolder, *dependencies: str) -> Checks:
    """Return the checks of the files of a package that drives the robot."""
    return [limited(package_files.check_depends, package, "rospy", "geometry_msgs", *dependencies),
            limited(package_files.check_scripts, package)]


def package(name: str, *dependencies: str) -> Checks:
    """Return the checks of a package that drives the robot."""
    return [partial(packages.check_exists, name, "create it with catkin_create_pkg, as in lesson 7"),
            *contents(name, *dependencies),
            partial(packages.check_built, name)]


def controller(start: str, namespace: str, start_master: str = "") -> Checks:
    """Return the checks of the running controller; start: what starts it, and the master if nothing else does."""
    return [partial(graph.check_master, start_master or start),
            partial(graph.check_node, f"{namespace}/{contract.CONTROLLER}", start)]


def drives(name: str, start: str, fix: str = IN_A_LOOP, namespace: str = "") -> Checks:
    """Return the checks of a running scenario; start: what starts it, fix: what brings it to 10 commands a second."""
    topic = f"{namespace}/cmd_vel"
    sender = [partial(graph.check_publishes, name, topic, start), partial(graph.check_no_other_publisher, topic, name)]
    if namespace:  # the nodes of a class run on other computers, too, and which package they are of is not known here
        sender = [partial(graph.check_commanded, topic, f"start it with {start}")]
    return [*sender, partial(motion.check_rate, name, 10, fix, topic), partial(motion.check_power, topic),
            partial(motion.check_wheels_turn, namespace)]


def lessons(own: str = "", namespace: str = "") -> Dict[int, Checks]:
    """Return the checks of each lesson by its number.

    own: the name of the pupil's package; namespace: of the robot, such as "/jetbot_07", for the lessons WITH_ROBOT.
    """
    known = package(CONTROLLER) + package(SCENARIO, CONTROLLER) + [partial(answers.check_needed, SCENARIO)]
    return {1: known, **robot_lessons(namespace), **own_lessons(own)}


def robot_lessons(namespace: str) -> Dict[int, Checks]:
    """Return the checks of the lessons WITH_ROBOT."""
    run = RUN + (namespace and f" __ns:={namespace}")
    launch, launch_scenario = (start + (namespace and f" robot_name:={namespace[1:]}")
                               for start in (LAUNCH, LAUNCH_SCENARIO))
    topic, keyboard = f"{namespace}/cmd_vel", f"{namespace}/{KEYBOARD}"
    return {
        2: controller(run, namespace, "roscore"),
        3: [*controller(run, namespace, "roscore"), partial(graph.check_commanded, topic, EXERCISE),
            partial(motion.check_turn, namespace)],
        4: [*([] if namespace else [partial(packages.check_exists, KEYBOARD, GET_KEYBOARD)]),
            *controller(run, namespace, "roscore"),
            partial(graph.check_node, keyboard, f"rosrun {KEYBOARD} {KEYBOARD}.py"),
            partial(motion.check_key, keyboard, topic)],
        5: [*controller(launch, namespace), partial(graph.check_launched_together, CONTROLLER, namespace=namespace)],
        6: [*controller(launch_scenario, namespace),
            partial(graph.check_launched_together, CONTROLLER, SCENARIO, namespace=namespace),
            *drives(SCENARIO, launch_scenario, "start it without rate:=", namespace)],
    }


def own_lessons(own: str) -> Dict[int, Checks]:
    """Return the checks of the lessons about the pupil's own package, by its name."""
    run, launch = (f"rosrun {own}, and the name of your script",
                   f"roslaunch {own}, the name of your launch file and, without a robot, i2c_bus:=fake")
    return {
        7: [*package(own), *controller(LAUNCH, ""), *drives(own, run)],
        8: [*package(own, CONTROLLER), limited(package_files.check_launch_files, own), *controller(launch, ""),
            partial(graph.check_launched_together, CONTROLLER, own), *drives(own, launch)],
        9: [*package(own), partial(package_files.check_drive, own, "metre")],
        10: [*package(own, *SEES), partial(graph.check_master, SIMULATE),
             partial(graph.check_publishes, own, sight.ANSWERS, run), sight.check_answer],
        11: [*package(own, *SEES), partial(package_files.check_drive, own, "camera")],
        12: [*package(own, *SEES), partial(package_files.check_drive, own, "roam")],
    }


def handed_in_package(place: Path) -> Dict[int, Checks]:
    """Return the checks, by the lesson's number, of the files of a package in this folder, anywhere on this computer.

    Nothing in the folder is executed.
    """
    known = [limited(package_files.check_handed_in, place), *contents(place)]
    return {
        7: known,
        8: [*known, limited(package_files.check_depends, place, CONTROLLER),
            limited(package_files.check_launch_files, place)],
        9: [*known, partial(package_files.check_drive, place, "metre")],
        10: [*known, limited(package_files.check_depends, place, *SEES)],
        11: [*known, partial(package_files.check_drive, place, "camera")],
        12: [*known, partial(package_files.check_drive, place, "roam")],
    }


def first_problem(lesson: int, own: str = "", namespace: str = "") -> Problem:
    """Return the first problem of a lesson, or None if it is done. Parameters: as for ``lessons``."""
    return find_problem(lessons(own, namespace)[lesson])


def find_problem(checks: Checks) -> Problem:
    """Return the first problem of these checks, or None."""
    return next(filter(None, (check() for check in checks)), None)


LAST = max(lessons())
