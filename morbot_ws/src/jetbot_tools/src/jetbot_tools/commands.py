"""Commands to type next, as they work where the program was started: in a shell that knows ROS, or after ./morbot."""

import shlex

from jetbot import fake
from jetbot.host import in_shell
from jetbot_control_node.parameters import PARAMETERS


def launch(**typed: object) -> str:
    """Return the command that starts the controller with these parameters; one at its default is left out."""
    words = [f"{name}:={short(value)}" for name, value in typed.items()
             if name not in PARAMETERS or value != PARAMETERS[name].default]
    return in_shell(shlex.join(["roslaunch", "jetbot_control_node", "jetbot_controller.launch", *words]))


def short(value: object) -> object:
    """Return plain ``fake`` for the folder that it means, any other value unchanged."""
    return "fake" if value == fake.expand("fake") else value


def fake_advice(name: str) -> str:
    """Return how to select "fake" for a parameter of doctor.py or calibrate.py."""
    return f"add: {name}:=fake"
