"""A differential-drive robot: two motors, the pose that results, and the walls that stop it. No ROS, and no clock."""

import math
from typing import Dict, NamedTuple, Tuple

from jetbot.fake.motors import dead_band_factor
from jetbot.kinematics import FULL_SPEED, WHEEL_RADIUS, WHEEL_SEPARATION, Pose, mix, unmix

from .variation import Variation
from .world import EMPTY, RADIUS, World

Pair = Tuple[float, float]  # left, right

STEP = 0.01             # s, by which the simulation advances
PWM_FREQUENCY = 1526.0  # Hz, at which a dead band is given
STOPPED_BELOW = 1e-5    # m/s; a wheel that slows down would never be at 0
RESOLUTION = 5e-5       # m; the robot stops this near to a wall, or nearer
SEPARATED = 0.01        # m from the walls; the next contact is another one


class Body(NamedTuple):
    """A robot's size and motors; ``simulation.simulation_parameters`` has the meaning and the source of each number."""

    wheel_separation: float = WHEEL_SEPARATION  # m
    wheel_diameter: float = 2 * WHEEL_RADIUS    # m, of the left wheel
    wheel_ratio: float = 1.0
    max_speed: float = FULL_SPEED               # m/s, of the left wheel
    motor_lag: float = 0.1                      # s
    dead_band: float = 0.05                     # duty
    swap_motors: bool = False
    invert_left: bool = False
    invert_right: bool = False
    variation: float = 0.0

    @property
    def changes(self) -> str:
        """What differs from the shipped robot: "max_speed 3 for 0.6, variation 0.2"; "" if nothing does."""
        return ", ".join(f"{name} {value:g}" + f" for {shipped:g}" * bool(shipped)
                         for name, value, shipped in zip(self._fields, self, JETBOT) if value != shipped)


JETBOT, ORIGIN, EXACT = Body(), Pose(), Variation()


class Motor:
    """A geared DC motor with its wheel, stopped at first.

    max_speed: m/s at full duty; lag: time constant in seconds (63 % of a change of speed), 0 for none;
    dead_band: duty in [0, 1) below which the motor does not turn, at ``PWM_FREQUENCY``; smaller at lower frequencies;
    grip: how far the robot drives for a metre that the wheel rolls.
    stalled: whether it gets some power, but too little to turn; duty: the last one applied; speed: m/s;
    distance: metres rolled so far, negative for backward.
    """

    def __init__(self, max_speed: float, lag: float, dead_band: float, grip: float = 1.0):
        self._max_speed, self._lag, self._dead_band, self._grip = max_speed, lag, dead_band, grip
        self.duty = self.speed = self.distance = 0.0
        self.stalled = False

    def step(self, duty: float, seconds: float, pwm_frequency: float = PWM_FREQUENCY) -> float:
        """Apply a duty in [-1, 1] for some time, at a frequency in Hz; return the metres that it drives."""
        starts_at = self._dead_band * dead_band_factor(pwm_frequency)
        self.duty, self.stalled = duty, 0 < abs(duty) < starts_at
        target = 0.0 if self.stalled else duty * self._max_speed
        error = self.speed - target
        decay = math.exp(-seconds / self._lag) if self._lag else 0.0
        rolled = target * seconds + error * self._lag * (1 - decay)  # the integral of the speed over the time
        self.speed = target + error * decay
        if not target and abs(self.speed) < STOPPED_BELOW:
            self.speed = 0.0
        self.distance += rolled
        return rolled * self._grip

    def block(self, rest: float) -> None:
        """Stop the wheel at once, before the last metres that ``step`` has returned."""
        self.speed = 0.0
        self.distance -= rest / self._grip

    @property
    def driven_speed(self) -> float:
        """How fast the wheel drives the robot, in m/s."""
        return self.speed * self._grip


class DiffDriveModel:
    """A robot with this body, at rest at ``pose`` in a world, whose walls stop it.

    body: the robot's; closed_loop: whether the board controls the speeds of the wheels, or sets their duties.
    variation: how the robot differs from its body.
    left, right: its motors; touching: whether a wall has stopped it, and it has not been ``SEPARATED`` from it since.
    """

    def __init__(self, body: Body = JETBOT, pose: Pose = ORIGIN, world: World = EMPTY, closed_loop: bool = False,
                 variation: Variation = EXACT):
        self.body, self._closed_loop = body, closed_loop
        self._variation = variation.controlled if closed_loop else variation
        self.enter(world)
        self.place(pose)

    def place(self, pose: Pose) -> None:
        """Put the robot at this pose, at rest and as new: its wheels have no speed and have not turned."""
        body = self.body
        self.pose, self.touching, self._free = pose, False, 0.0
        dead_band = 0.0 if self._closed_loop else body.dead_band
        self.left, self.right = (
            Motor(max_speed * wheel.gain, body.motor_lag, dead_band * wheel.dead_band, wheel.grip) for max_speed, wheel
            in zip((body.max_speed, body.max_speed * body.wheel_ratio), (self._variation.left, self._variation.right)))

    def enter(self, world: World) -> None:
        """Put this world around the robot, in the place of the one that it is in."""
        self.world, self.touching, self._free = world, False, 0.0  # m that it may move before a wall can be near

    def step(self, speeds: Pair, seconds: float = STEP, pwm_frequency: float = PWM_FREQUENCY) -> None:
        """Drive for some seconds at the board's wheel speeds (left, right), at a PWM frequency in Hz, up to a wall.

        They are duties in [-1, 1]; of a closed loop, m/s of wheels that are 2 m apart.
        """
        speeds = self._wired(*speeds)
        if self._closed_loop:
            speeds = mix(*unmix(*speeds), self.body.wheel_separation, self.body.max_speed)
        left, right = speeds
        supply = 1 - self._variation.sag * (abs(left) + abs(right)) / 2
        left, right = (motor.step(speed * supply, seconds, pwm_frequency)
                       for motor, speed in ((self.left, left), (self.right, right)))
        if left or right:
            self._drive(left, right)

    def _wired(self, left: float, right: float) -> Pair:
        """Return the speeds of the wheels (left, right) that are wired to these outputs of the board."""
        body = self.body
        left, right = (right, left) if body.swap_motors else (left, right)
        return -left if body.invert_left else left, -right if body.invert_right else right

    def _drive(self, left: float, right: float) -> None:
        """Move as the wheels have rolled, in m, up to a wall: by conservative advancement.

        A robot that moves no farther than its clearance touches nothing, so each part of the way is that long. One that
        is on a wall already drives on.
        """
        width, start, driven = self.body.wheel_separation, self.pose, 0.0
        travel = abs(left + right) / 2 + RADIUS * abs(right - left) / width  # no point moves farther
        if travel < self._free:
            self.pose, self._free = start.integrate_arc(left, right, width), self._free - travel
            return
        clearance = self.world.clearance(start)
        while driven < 1:
            next_driven = min(1.0, driven + max(clearance - RESOLUTION, RESOLUTION) / travel)
            next_pose = start.integrate_arc(left * next_driven, right * next_driven, width)
            next_clearance = self.world.clearance(next_pose)
            if next_clearance <= 0 < clearance:  # there it would touch
                self.left.block(left * (1 - driven))
                self.right.block(right * (1 - driven))
                break
            self.pose, driven, clearance = next_pose, next_driven, next_clearance
        self.touching = driven < 1 or (self.touching and clearance < SEPARATED)
        self._free = clearance - SEPARATED

    @property
    def moving(self) -> bool:
        """Whether a wheel turns."""
        return bool(self.left.speed or self.right.speed)

    @property
    def velocity(self) -> Tuple[float, float]:
        """The velocity (linear in m/s, angular in rad/s) in the robot's own frame."""
        return unmix(self.left.driven_speed, self.right.driven_speed, self.body.wheel_separation)

    @property
    def joints(self) -> Tuple[Pair, Pair]:
        """The rotations of the wheels (left, right) since the start in rad, and their angular speeds in rad/s."""
        left, right, radius = self.left, self.right, self.body.wheel_diameter / 2
        right_radius = radius * self.body.wheel_ratio
        return ((left.distance / radius, right.distance / right_radius),
                (left.speed / radius, right.speed / right_radius))

    @property
    def stalled(self) -> Dict[str, float]:
        """The duties of the wheels that get some power, but too little to turn; their names are left and right."""
        wheels = {"left": self.left, "right": self.right}
        return {name: wheel.duty for name, wheel in wheels.items() if wheel.stalled}
