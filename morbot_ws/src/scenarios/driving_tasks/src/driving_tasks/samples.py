"""Where a robot was at one moment."""

from typing import NamedTuple

from jetbot.kinematics import Pose


class Sample(NamedTuple):
    """time: s, of the message's own stamp; pose: on the map; speed: m/s, forward is positive."""

    time: float
    pose: Pose
    speed: float
