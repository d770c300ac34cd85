"""Where a robot is, by what its wheels are given. No ROS, no thread and no clock."""

from typing import NamedTuple, Tuple

from jetbot.guard.process import HEARTBEAT_TIMEOUT
from jetbot.kinematics import WHEEL_RADIUS, Pose, unmix
from jetbot.motor import Motor

from ..control.state_machine import STOPPED
from ..control.supervisor import Step

MAX_GAP = HEARTBEAT_TIMEOUT  # s between two reports after which the guard has stopped the wheels

Pair = Tuple[float, float]  # left, right


class OdometryState(NamedTuple):
    """Where the robot is at the monotonic time ``at``, and how its wheels turn. Immutable.

    x, y: m; yaw: rad, to the left, within half a turn; path_length, total_rotation: in sum, m and rad;
    speeds: of the wheels, m/s; distances: that they have rolled, m, negative for backward.
    drift: the error of a path or a rotation, as a fraction of it; an estimate: speeds vary with the battery.
    """

    wheel_separation: float
    drift: float = 0.1
    at: float = 0.0
    x: float = 0.0
    y: float = 0.0
    yaw: float = 0.0
    path_length: float = 0.0
    total_rotation: float = 0.0
    speeds: Pair = STOPPED
    distances: Pair = (0.0, 0.0)

    @property
    def moving(self) -> bool:
        """Whether a wheel turns."""
        return self.speeds != STOPPED

    @property
    def velocity(self) -> Pair:
        """The robot's velocity: forward in m/s, to the left in rad/s."""
        return unmix(*self.speeds, self.wheel_separation)

    @property
    def joints(self) -> Tuple[Pair, Pair]:
        """The rotations of the wheels (left, right) in rad, and their angular speeds in rad/s."""
        (left, right), (left_speed, right_speed) = self.distances, self.speeds
        return (left / WHEEL_RADIUS, right / WHEEL_RADIUS), (left_speed / WHEEL_RADIUS, right_speed / WHEEL_RADIUS)

    def advance(self, now: float) -> "OdometryState":
        """Return the motion at the time ``now``, along the arc of the wheels' speeds.

        After ``MAX_GAP``, as of a program that was frozen, the wheels have stopped.
        """
        frozen, seconds = now - self.at > MAX_GAP, min(max(0.0, now - self.at), MAX_GAP)
        forward, turn = self.velocity
        left, right = rolled = tuple(speed * seconds for speed in self.speeds)
        pose = Pose(self.x, self.y, self.yaw).integrate_arc(left, right, self.wheel_separation)
        return self._replace(
            at=now, **pose._asdict(), speeds=STOPPED if frozen else self.speeds,
            distances=tuple(map(sum, zip(self.distances, rolled))),
            path_length=self.path_length + abs(forward * seconds),
            total_rotation=self.total_rotation + abs(turn * seconds))


class DeadReckoning:
    """Keeps the robot's ``motion``, as it watches the Supervisor; another thread may read it.

    left, right: the robot's motors; max_speed: m/s of a wheel at full power; wheel_separation: m.
    """

    def __init__(self, left: Motor, right: Motor, max_speed: float, wheel_separation: float):
        self._motors, self._max_speed = (left, right), max_speed
        self.motion = OdometryState(wheel_separation)

    def __call__(self, step: Step) -> None:
        speeds = tuple(self._max_speed * motor.speed_of(duty) for motor, duty in zip(self._motors, step.duties))
        self.motion = self.motion.advance(step.at)._replace(speeds=speeds)
