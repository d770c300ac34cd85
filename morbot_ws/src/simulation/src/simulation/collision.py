"""Walls stop the robot: how far it drives before it touches one."""

from typing import Tuple

from jetbot.kinematics import Pose

from .world import RADIUS, World

RESOLUTION = 5e-5  # m; the robot stops this near to a wall, or nearer
SEPARATED = 0.01   # m from the walls; the next contact is another one


class Collision:
    """The walls of a world, for one robot.

    touching: whether the robot has been stopped by a wall, and has not been ``SEPARATED`` from it since.
    """

    def __init__(self, world: World):
        self._world = world
        self._pose, self._margin = None, 0.0  # where the robot was, and how far it may drive from there unchecked, m
        self.touching = False

    def drive(self, pose: Pose, left: float, right: float, wheel_separation: float) -> Tuple[Pose, float]:
        """Return where the robot is after its wheels have rolled, and the fraction of the way that it drove.

        That is 1.0 unless a wall stops it; a robot that is on a wall already drives on. All lengths in m.
        """
        reach = abs(left + right) / 2 + RADIUS * abs(right - left) / wheel_separation  # of each point, at most
        if pose == self._pose and reach < self._margin and not self.touching:
            self._pose, self._margin = pose.integrate_arc(left, right, wheel_separation), self._margin - reach
            return self._pose, 1.0
        self._pose, driven, self._margin = self._advance(pose, left, right, wheel_separation, reach)
        self.touching = driven < 1 or self.touching and self._margin < SEPARATED
        return self._pose, driven

    def _advance(self, start: Pose, left: float, right: float, wheel_separation: float,
                 reach: float) -> Tuple[Pose, float, float]:
        """Return the last pose before a wall, its fraction of the way, and its clearance: conservative advancement.

        A robot that drives no farther than its clearance touches nothing, so each part of the way is that long.
        """
        pose, driven, clearance = start, 0.0, self._world.clearance(start)
        while driven < 1:
            fraction = min(1.0, driven + max(clearance - RESOLUTION, RESOLUTION) / reach) if reach else 1.0
            following = start.integrate_arc(left * fraction, right * fraction, wheel_separation)
            distance = self._world.clearance(following)
            if distance <= 0 < clearance:
                break
            pose, driven, clearance = following, fraction, distance
        return pose, driven, clearance
