"""Gentle starts: limits how fast the wheels speed up. No thread, no clock: times are monotonic seconds, handed in."""

import math
from typing import Dict, Tuple

from jetbot.boards import MotorDriver
from jetbot.kinematics import WHEEL_SEPARATION, clamp, mix, unmix

from .state_machine import STOPPED

STEP_INTERVAL = 0.008  # s between two steps of a ramp; 0.02 at most with the transfers on a bus of 100 kHz
MAX_STEP = 0.02        # s that a step counts at most: one that is late makes the wheels no faster
MAX_GAP = 0.5          # s between two steps; after more, the guard or the board's own timer may have stopped the wheels


class Ramp:
    """Limits the acceleration of both wheels, and keeps to the arc that is commanded.

    acceleration_limit: in m/s^2, of a wheel; 0: none. wheel_separation: in m.
    full_speed: of a wheel, in m/s; no command makes it faster.

    Only speeding up takes time. A wheel slows down and stops at once; one that reverses speeds up from zero.
    """

    def __init__(self, acceleration_limit: float = 0.0, wheel_separation: float = 2.0,
                 full_speed: float = math.inf):
        self.acceleration_limit = acceleration_limit
        self._separation, self._full_speed = wheel_separation, full_speed
        self._wanted = self._given = STOPPED  # wheel speeds (left, right) in m/s
        self._stepped_at = -math.inf

    @property
    def active(self) -> bool:
        """Whether the wheels have yet to speed up: the next ``limit`` is due after STEP_INTERVAL."""
        return self._given != self._wanted

    def reset(self) -> None:
        """Start again at zero: something other than a command has stopped the wheels."""
        self._given = STOPPED

    def limit(self, velocity: Tuple[float, float], now: float) -> Tuple[float, float]:
        """Return the velocity (linear in m/s, angular in rad/s) to drive from ``now`` on, to reach this one."""
        if not self.acceleration_limit:
            return velocity
        elapsed, self._stepped_at = now - self._stepped_at, now
        if elapsed > MAX_GAP:
            self.reset()
        self._wanted = tuple(clamp(speed, self._full_speed) for speed in mix(*velocity, self._separation))
        fraction = self._fraction(self.acceleration_limit * min(elapsed, MAX_STEP))
        if fraction >= 1:
            self._given = self._wanted
            return velocity
        self._given = tuple(fraction * speed for speed in self._wanted)
        return unmix(*self._given, self._separation)

    def _fraction(self, gain):
        """Return how much of the wanted speeds both wheels reach if neither gets faster by more than ``gain`` m/s."""
        return min((max(0.0, given / wanted) + gain / abs(wanted)
                    for given, wanted in zip(self._given, self._wanted) if wanted), default=1.0)


def make_ramp(parameters: Dict[str, object], driver: MotorDriver) -> Ramp:
    """Return the Ramp that the parameters describe, for this board."""
    if driver.closed_loop:
        return Ramp(parameters["acceleration_limit"], WHEEL_SEPARATION, driver.limit)  # it takes a Twist as it is
    alphas = (abs(parameters[f"{side}_motor_alpha"]) for side in ("left", "right"))
    weakest = min([1.0, *filter(None, alphas)])  # the wheel of this trim reaches full power last
    return Ramp(parameters["acceleration_limit"], parameters["wheel_separation"], parameters["max_speed"] / weakest)
