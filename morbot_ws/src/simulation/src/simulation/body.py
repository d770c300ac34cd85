"""The body of a differential-drive robot: two motors, and the pose that they bring it to."""

from .pose import ORIGIN


class Body:
    """left, right: a Motor each; wheel_separation, wheel_diameter: metres; pose: where it starts."""

    def __init__(self, left, right, wheel_separation, wheel_diameter, pose=ORIGIN):
        self.left = left
        self.right = right
        self.pose = pose
        self._wheel_separation = wheel_separation
        self._wheel_diameter = wheel_diameter

    def move(self, duties, seconds):
        """Move on for some time under the duties (left, right), each in [-1, 1]."""
        rolled = [wheel.turn(duty, seconds) for wheel, duty in zip((self.left, self.right), duties)]
        self.pose = self.pose.moved(*rolled, self._wheel_separation)

    @property
    def velocity(self):
        """Now: (linear in m/s, angular in rad/s), in the frame of the robot."""
        return (self.left.speed + self.right.speed) / 2, (self.right.speed - self.left.speed) / self._wheel_separation

    @property
    def wheel_angles(self):
        """How far the wheels (left, right) have turned since the start, in radians."""
        return tuple(wheel.distance / (self._wheel_diameter / 2) for wheel in (self.left, self.right))

    @property
    def wheel_rates(self):
        """How fast the wheels (left, right) turn now, in rad/s."""
        return tuple(wheel.speed / (self._wheel_diameter / 2) for wheel in (self.left, self.right))
