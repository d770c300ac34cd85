"""How a robot moves, and how uncertain the pose is that adds up its own motion. No ROS."""

import math
from typing import NamedTuple

RESOLUTION = 0.001              # m and rad
MAX_YAW = math.pi / 3 ** 0.5    # rad: of a yaw that may be any


class Velocity(NamedTuple):
    """How far the robot moved in the last ``seconds``: ``forward`` in m, ``turn`` in rad to the left."""

    seconds: float
    forward: float
    turn: float


class Deviation(NamedTuple):
    """The standard deviations of a pose: ``position``, of x and of y, in m, and ``yaw`` in rad. Immutable.

    drift: that of a rotation and, straight ahead, of a path, as a fraction of it.
    """

    drift: float
    position: float = RESOLUTION
    yaw: float = RESOLUTION

    def grow(self, forward: float, turn: float) -> "Deviation":
        """Return the deviations after one more step: ``forward`` in m, ``turn`` in rad.

        An uncertain yaw makes the path that follows uncertain. A turn on the spot leaves the position as it is.
        """
        yaw = min(self.yaw + self.drift * abs(turn), MAX_YAW)
        return self._replace(yaw=yaw, position=self.position + abs(forward) * min(math.hypot(self.drift, yaw), 1.0))
