"""The simulated reflectance sensor: three eyes below the front of the robot, which look at the floor."""

from typing import Tuple

from jetbot.kinematics import Pose, from_frame

from .world import World

EYES = {"left": (0.05, 0.015), "middle": (0.05, 0.0), "right": (0.05, -0.015)}  # in the robot's own frame, m


def read(world: World, pose: Pose) -> Tuple[float, ...]:
    """Return what the EYES see with the robot at this pose: each from 0 (a dark line) to 1 (the light floor)."""
    return tuple(world.reflectance(*from_frame(pose, eye)) for eye in EYES.values())
