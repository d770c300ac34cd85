"""The pose of a robot on the floor, and how two wheels change it."""

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """x, y in metres; yaw in radians, counterclockwise from the x axis (REP 103)."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    def integrate_arc(self, left: float, right: float, wheel_separation: float) -> "Pose":
        """Return the pose at the end of the arc on which the wheels roll ``left`` and ``right`` metres."""
        rotation, arc = (right - left) / wheel_separation, (left + right) / 2
        chord = arc * math.sin(rotation / 2) / (rotation / 2) if rotation else arc
        heading = self.yaw + rotation / 2
        return Pose(self.x + chord * math.cos(heading), self.y + chord * math.sin(heading),
                    math.remainder(self.yaw + rotation, math.tau))
