"""The table of the lessons: what must be there after each."""

from .commands import key_pressed, publishes_at
from .files import built, depends, found, launch_file_includes_controller, scripts_start
from .graph import has_type, launched_together, listens, master_up, nobody_else_publishes, node_up, publishes
from .wheels import wheels_obey, wheels_turn

ROBOT, SCENARIO, KEYBOARD = "jetbot_control_node", "workshop", "teleop_twist_keyboard"
RUN = f"rosrun {ROBOT} jetbot_controller.py _i2c_bus:=fake"
LAUNCH = f"roslaunch {ROBOT} jetbot_controller.launch i2c_bus:=fake"
LAUNCH_SCENARIO = f"roslaunch {SCENARIO} workshop_jetbot_controller.launch i2c_bus:=fake"


def package(name, *dependencies):
    """What makes a package that drives."""
    return [
        (found, name, "make it with catkin_create_pkg, as lesson 7 does"),
        (depends, name, "rospy", "geometry_msgs", *dependencies),
        (scripts_start, name),
        (built, name),
    ]


def controller(start, start_master=None):
    """What a controller that runs does; start: the command that starts it, and the master where no other does."""
    return [
        (master_up, start_master or start),
        (node_up, "/jetbot_controller", start),
        (listens, "/jetbot_controller", "/cmd_vel"),
        (has_type, "/cmd_vel", "geometry_msgs/Twist"),
    ]


def drives(name, start, remedy="publish in a loop, with rate = rospy.Rate(10) and rate.sleep()"):
    """What a scenario that runs does; start: the command that starts it, remedy: what brings it to its rate."""
    return [
        (publishes, name, "/cmd_vel", start),
        (nobody_else_publishes, "/cmd_vel", name),
        (publishes_at, name, 10, remedy),
        (wheels_turn,),
    ]


def lessons(own):
    """Number: checks, each a function and its arguments; own: the name of the pupil's package."""
    run_own = f"rosrun {own}, and the name of your script"
    launch_own = f"roslaunch {own}, the name of your launch file and, without a robot, i2c_bus:=fake"
    return {
        1: package(ROBOT) + package(SCENARIO, ROBOT),
        2: controller(RUN, "roscore"),
        3: [*controller(RUN, "roscore"), (nobody_else_publishes, "/cmd_vel"), (wheels_obey,)],
        4: [(found, KEYBOARD, "get it with git clone and ./morbot setup, as lesson 4 does"),
            *controller(RUN, "roscore"),
            (node_up, f"/{KEYBOARD}", f"rosrun {KEYBOARD} {KEYBOARD}.py"), (key_pressed, f"/{KEYBOARD}")],
        5: [*controller(LAUNCH), (launched_together, ROBOT)],
        6: [*controller(LAUNCH_SCENARIO), (launched_together, ROBOT, SCENARIO),
            *drives(SCENARIO, LAUNCH_SCENARIO, "start it without rate:=")],
        7: [*package(own), *controller(LAUNCH), *drives(own, run_own)],
        8: [*package(own, ROBOT), (launch_file_includes_controller, own), *controller(launch_own),
            (launched_together, ROBOT, own), *drives(own, launch_own)],
    }


FIRST_OWN, LAST = 7, 8  # the lessons about the pupil's own package


def first_missing(number, own=None):
    """The first sentence of a lesson's checks; None when all is there. own: the name of the pupil's package."""
    for check, *arguments in lessons(own)[number]:
        sentence = check(*arguments)
        if sentence:
            return sentence
    return None
