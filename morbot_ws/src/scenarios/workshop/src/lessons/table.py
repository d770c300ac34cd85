"""The table of the lessons: what must be there after each."""

from .commands import key_pressed, publishes_at
from .files import built, depends, found, launch_file_includes_controller, scripts_start
from .graph import has_type, launched_together, listens, master_up, nobody_publishes, node_up, publishes
from .wheels import wheels_obey, wheels_turn

OWN = object()  # stands for the pupil's own package
ROBOT, SCENARIO, KEYBOARD = "jetbot_control_node", "workshop", "teleop_twist_keyboard"


def package(name, *dependencies):
    """What makes a package that drives."""
    return [
        (found, name, "make it with catkin_create_pkg, as lesson 7 does"),
        (depends, name, "rospy", "geometry_msgs", *dependencies),
        (scripts_start, name),
        (built, name),
    ]


def drives(name):
    """What a scenario that runs does."""
    return [(publishes, name, "/cmd_vel"), (publishes_at, name, 10), (wheels_turn,)]


CONTROLLER = [
    (master_up,),
    (node_up, "/jetbot_controller", f"rosrun {ROBOT} jetbot_controller.py _i2c_bus:=fake"),
    (listens, "/jetbot_controller", "/cmd_vel"),
    (has_type, "/cmd_vel", "geometry_msgs/Twist"),
]

TELEOP = [
    (found, KEYBOARD, "get it with git clone and ./morbot setup, as lesson 4 does"),
    *CONTROLLER,
    (node_up, f"/{KEYBOARD}", f"rosrun {KEYBOARD} {KEYBOARD}.py"),
    (key_pressed, f"/{KEYBOARD}"),
]

LESSONS = {  # number: checks, each a function and its arguments; the first that finds something missing is told
    1: package(ROBOT) + package(SCENARIO, ROBOT),
    2: CONTROLLER,
    3: [*CONTROLLER, (nobody_publishes, "/cmd_vel"), (wheels_obey,)],
    4: TELEOP,
    5: [*CONTROLLER, (launched_together, ROBOT)],
    6: [*CONTROLLER, (launched_together, ROBOT, SCENARIO), *drives(SCENARIO)],
    7: [*package(OWN), *CONTROLLER, *drives(OWN)],
    8: [*package(OWN, ROBOT), (launch_file_includes_controller, OWN), *CONTROLLER, (launched_together, ROBOT, OWN),
        *drives(OWN)],
}
LAST = max(LESSONS)


def needs_package(number):
    """Whether the lesson is about the pupil's own package."""
    return any(OWN in arguments for _, *arguments in LESSONS[number])


def first_missing(number, own=None):
    """The first sentence of a lesson's checks; None when all is there. own: the name of the pupil's package."""
    for check, *arguments in LESSONS[number]:
        sentence = check(*(own if argument is OWN else argument for argument in arguments))
        if sentence:
            return sentence
    return None
