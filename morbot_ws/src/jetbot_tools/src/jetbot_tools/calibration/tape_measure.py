"""Asks how far a robot drives and turns, so that it obeys metres and radians."""

import math
from typing import Any, Callable, Dict, List, Optional

from jetbot.kinematics import WHEEL_SEPARATION
from jetbot.motor import duty

from ..terminal import YES_OR_NO, choose, number
from .corrections import ALPHAS, proportional_alphas
from .motions import DRIVE_SPEED, WheelStep, gentle, spin

DRIVE_TIME = 2.0  # s
TURN = 720        # degrees
INTRODUCTION = """
With a tape measure, commands become metres and radians: linear.x in m/s, angular.z in rad/s.
Without, they stay as they are in the workshop. Put the robot on the floor, with two metres ahead of it."""

Drive = Callable[[str, List[WheelStep]], Optional[WheelStep]]  # as Wizard.drive_until_key


def measure(drive: Drive, parameters: Dict[str, Any]) -> None:
    """Add max_speed and wheel_separation to a robot's parameters; a person may skip each."""
    print(INTRODUCTION)
    motion = gentle(DRIVE_SPEED, DRIVE_SPEED, DRIVE_TIME, parameters["min_duty"])
    centimetres = ask(drive, "Measure how far it drives?", f"The robot will drive ahead for {DRIVE_TIME:.0f} s.",
                      motion, "How many centimetres did it drive?", 10, 200)
    if not centimetres:
        return
    obey_metres(parameters, centimetres / 100 / DRIVE_TIME)
    degrees = ask(drive, "Measure how far it turns?", "The robot will turn left on the spot, about twice round.",
                  spin(math.radians(TURN), {**parameters, "wheel_separation": WHEEL_SEPARATION}),
                  f"How many degrees did it turn? Twice round is {TURN}.", 180, 1440)
    if degrees:
        parameters["wheel_separation"] = round(WHEEL_SEPARATION * TURN / degrees, 4)


def obey_metres(parameters: Dict[str, Any], speed: float) -> None:
    """Add the max_speed of a robot that drives at ``speed`` m/s at DRIVE_SPEED, and leave out its min_duty.

    A min_duty is added to each command, whereas above it a motor's speed is proportional to its duty.
    """
    min_duty = parameters.pop("min_duty")
    max_speed = round(speed / duty(DRIVE_SPEED, min_duty), 4)
    alphas = proportional_alphas(*(parameters[name] for name in ALPHAS), min_duty)
    parameters.update(zip(ALPHAS, alphas), max_speed=max_speed)
    print(f"For true speeds, min_duty is left out: below {min_duty * max_speed:.3f} m/s, a wheel may not turn. "
          f"With min_duty:={min_duty} it turns, but faster than commanded.")


def ask(drive: Drive, offer: str, announcement: str, motion: List[WheelStep], question: str,
        lowest: float, highest: float) -> float:
    """Return what a person measures after a motion, or 0 if that is skipped."""
    while choose(offer, YES_OR_NO, enter="no"):
        if not drive(announcement, motion):
            return number(f"{question} Press Enter alone to skip this.", highest, lowest)
        print("The motion was stopped, so there is nothing to measure.")
    return 0.0
