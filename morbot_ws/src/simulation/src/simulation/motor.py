"""A geared motor and its wheel: it does not start below a dead band, and reaches its speed with a lag."""

import math


class Motor:
    """One wheel, standing at first.

    max_speed: m/s at full duty; dead_band: duty in [0, 1) below which it does not turn;
    lag: seconds to 63 % of a change of speed (the time constant of a first-order lag), 0 for none.
    speed: m/s now; distance: metres rolled so far, less when backward.
    """

    def __init__(self, max_speed, lag, dead_band):
        self._max_speed = max_speed
        self._lag = lag
        self._dead_band = dead_band
        self.speed = self.distance = 0.0

    def turn(self, duty, seconds):
        """Turn under a duty in [-1, 1] for some time; the metres that the wheel rolls meanwhile."""
        target = duty * self._max_speed if abs(duty) >= self._dead_band else 0.0
        excess = self.speed - target
        left = math.exp(-seconds / self._lag) if self._lag else 0.0
        rolled = target * seconds + excess * self._lag * (1 - left)  # the integral of the speed over the time
        self.speed = target + excess * left
        self.distance += rolled
        return rolled
