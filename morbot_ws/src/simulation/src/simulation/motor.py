"""A geared DC motor with its wheel: a dead band and a first-order lag."""

import math


class Motor:
    """One wheel, stopped at first.

    max_speed: m/s at full duty; lag: time constant in seconds (63 % of a change of speed), 0 for none;
    dead_band: duty in [0, 1) below which the motor does not turn.
    speed: m/s; distance: metres rolled so far, negative for backward.
    """

    def __init__(self, max_speed: float, lag: float, dead_band: float):
        self._max_speed = max_speed
        self._lag = lag
        self._dead_band = dead_band
        self.speed = self.distance = 0.0

    def step(self, duty: float, seconds: float) -> float:
        """Apply a duty in [-1, 1] for some time; return the metres that the wheel rolls."""
        target = duty * self._max_speed if abs(duty) >= self._dead_band else 0.0
        error = self.speed - target
        decay = math.exp(-seconds / self._lag) if self._lag else 0.0
        rolled = target * seconds + error * self._lag * (1 - decay)  # the integral of the speed over the time
        self.speed = target + error * decay
        self.distance += rolled
        return rolled
