"""Where a robot is on the floor, and how two wheels move it."""

import math
from typing import NamedTuple


class Pose(NamedTuple):
    """x, y in metres; yaw in radians, counterclockwise from the x axis (REP 103)."""

    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0

    def moved(self, left, right, wheel_separation):
        """The pose after the wheels have rolled ``left`` and ``right`` metres, evenly: along an arc of a circle."""
        turn = (right - left) / wheel_separation
        arc = (left + right) / 2
        chord = arc * math.sin(turn / 2) / (turn / 2) if turn else arc
        along = self.yaw + turn / 2
        return Pose(self.x + chord * math.cos(along), self.y + chord * math.sin(along), normalized(self.yaw + turn))


ORIGIN = Pose()


def normalized(angle):
    """The same angle within [-pi, pi]."""
    return math.remainder(angle, 2 * math.pi)
