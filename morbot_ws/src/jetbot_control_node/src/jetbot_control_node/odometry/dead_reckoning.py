"""Where a robot is, by what its wheels are given. No ROS, no thread and no clock."""

from typing import NamedTuple, Tuple

from jetbot.guard.process import HEARTBEAT_TIMEOUT
from jetbot.kinematics import WHEEL_RADIUS, Pose, clamp
from jetbot.motor import Motor

from ..control.state import STOPPED
from ..control.supervisor import Step
from .motion import Deviation, Velocity

MAX_GAP = HEARTBEAT_TIMEOUT  # s between two reports after which the guard has stopped the wheels
MAX_SPEED = 100.0            # m/s and
MIN_SEPARATION = 0.001       # m: so that all sums stay finite, whatever the parameters are
DRIFT = 0.1                  # see ``Deviation``: an estimate; speeds vary with the battery

Pair = Tuple[float, float]  # left, right


class Motion(NamedTuple):
    """Where the robot is at the monotonic time ``at``, and how its wheels turn. Immutable.

    x, y: m; yaw: rad, to the left, within half a turn; deviation: how uncertain they are;
    speeds: of the wheels, m/s; distances: that they have rolled, m, negative for backward.
    """

    wheel_separation: float
    at: float = 0.0
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    deviation: Deviation = Deviation(DRIFT)
    speeds: Pair = STOPPED
    distances: Pair = (0.0, 0.0)

    @property
    def moving(self) -> bool:
        """Whether a wheel turns."""
        return self.speeds != STOPPED

    @property
    def velocity(self) -> Velocity:
        """The robot's velocity, as the motion of one second."""
        left, right = self.speeds
        return Velocity(1.0, (left + right) / 2, (right - left) / self.wheel_separation)

    @property
    def joints(self) -> Tuple[Pair, Pair]:
        """The rotations of the wheels (left, right) in rad, and their angular speeds in rad/s."""
        (left, right), (left_speed, right_speed) = self.distances, self.speeds
        return (left / WHEEL_RADIUS, right / WHEEL_RADIUS), (left_speed / WHEEL_RADIUS, right_speed / WHEEL_RADIUS)

    def advance(self, now: float) -> "Motion":
        """Return the motion at the time ``now``, along the arc of the wheels' speeds.

        After ``MAX_GAP``, as of a program that was frozen, the wheels have stopped.
        """
        frozen, seconds = now - self.at > MAX_GAP, clamp(max(0.0, now - self.at), MAX_GAP)
        _, forward, turn = self.velocity
        left, right = rolled = tuple(speed * seconds for speed in self.speeds)
        pose = Pose(self.x, self.y, self.yaw).integrate_arc(left, right, self.wheel_separation)
        return self._replace(
            at=now, **pose._asdict(), speeds=STOPPED if frozen else self.speeds,
            distances=tuple(map(sum, zip(self.distances, rolled))),
            deviation=self.deviation.grow(forward * seconds, turn * seconds))


class DeadReckoning:
    """Keeps the robot's ``motion``, as it watches the Supervisor; another thread may read it.

    left, right: the robot's motors; max_speed: m/s of a wheel at full power; wheel_separation: m.
    """

    def __init__(self, left: Motor, right: Motor, max_speed: float, wheel_separation: float):
        self._motors, self._max_speed = (left, right), max_speed
        self.motion = Motion(max(wheel_separation, MIN_SEPARATION))

    def __call__(self, step: Step) -> None:
        speeds = tuple(clamp(self._max_speed * motor.speed_of(duty), MAX_SPEED)
                       for motor, duty in zip(self._motors, step.duties))
        self.motion = self.motion.advance(step.at)._replace(speeds=speeds)
