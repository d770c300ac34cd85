"""Walls stop the robot: how far it drives before it touches one."""

from typing import Optional, Tuple

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
        self._pose: Optional[Pose] = None  # after the last motion
        self._margin = 0.0                 # m that each point of the robot may move from there and touch no wall
        self.touching = False

    def drive(self, pose: Pose, left: float, right: float, wheel_separation: float) -> Tuple[Pose, float]:
        """Return where the robot is after its wheels have rolled, and the fraction of the way that it drove.

        That is 1.0 unless a wall stops it; a robot that is on a wall already drives on. All lengths in m.
        """
        travel = abs(left + right) / 2 + RADIUS * abs(right - left) / wheel_separation  # of no point is it more
        if pose == self._pose and travel < self._margin and not self.touching:  # too far from all walls
            self._pose, self._margin = pose.integrate_arc(left, right, wheel_separation), self._margin - travel
            return self._pose, 1.0
        self._pose, driven, self._margin = self._advance(pose, left, right, wheel_separation, travel)
        self.touching = driven < 1 or (self.touching and self._margin < SEPARATED)
        return self._pose, driven

    def _advance(self, start: Pose, left: float, right: float, wheel_separation: float,
                 travel: float) -> Tuple[Pose, float, float]:
        """Return the last pose before a wall, its fraction of the way, and its clearance: conservative advancement.

        A robot that moves no farther than its clearance touches nothing, so each part of the way is that long.
        """
        pose, driven, clearance = start, 0.0, self._world.clearance(start)
        while driven < 1:
            part = max(clearance - RESOLUTION, RESOLUTION) / travel if travel else 1.0
            next_driven = min(1.0, driven + part)
            next_pose = start.integrate_arc(left * next_driven, right * next_driven, wheel_separation)
            next_clearance = self._world.clearance(next_pose)
            if next_clearance <= 0 < clearance:  # there it would touch
                break
            pose, driven, clearance = next_pose, next_driven, next_clearance
        return pose, driven, clearance
