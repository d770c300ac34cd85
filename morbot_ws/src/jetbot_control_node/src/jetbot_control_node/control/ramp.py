"""Gentle starts: limits how fast the wheels speed up. No thread, no clock: times are monotonic seconds, handed in."""

import math
from typing import Dict, Optional, Tuple

from jetbot.boards import MotorDriver
from jetbot.kinematics import WHEEL_SEPARATION, mix, unmix

from .state_machine import STOPPED

STEP_INTERVAL = 0.008  # s between two steps of a ramp; 0.02 at most with the transfers on a bus of 100 kHz
MAX_STEP = 0.02        # s that a step counts at most: one that is late makes the wheels no faster
MAX_GAP = 0.5          # s between two steps; after more, the guard or the board's own timer may have stopped the wheels


class Ramp:
    """Limits the acceleration of both wheels, and keeps to the arc that is commanded.

    acceleration_limit: by how much the speed of a wheel may grow in a second.
    wheel_separation: in m, if the speeds are not those of the wheels, but of wheels 2 m apart.

    Only speeding up takes time. A wheel slows down and stops at once; one that reverses speeds up from zero.
    """

    def __init__(self, acceleration_limit: float, wheel_separation: Optional[float] = None):
        self._acceleration_limit, self._separation = acceleration_limit, wheel_separation
        self._wanted = self._given = STOPPED  # speeds (left, right)
        self._stepped_at = -math.inf

    @property
    def active(self) -> bool:
        """Whether the wheels have yet to speed up: the next ``limit`` is due after STEP_INTERVAL."""
        return self._given != self._wanted

    def reset(self) -> None:
        """Start again at zero: something other than a command has stopped the wheels."""
        self._given = STOPPED

    def limit(self, speeds: Tuple[float, float], now: float) -> Tuple[float, float]:
        """Return the speeds (left, right) to drive from ``now`` on, to reach these."""
        elapsed, self._stepped_at = now - self._stepped_at, now
        if elapsed > MAX_GAP:
            self.reset()
        fraction = self._fraction(speeds, self._acceleration_limit * min(elapsed, MAX_STEP))
        self._wanted = speeds
        self._given = speeds if fraction >= 1 else (fraction * speeds[0], fraction * speeds[1])
        return self._given

    def _fraction(self, speeds, gain):
        """Return how much of these speeds both wheels reach if neither gets faster by more than ``gain``."""
        return min((max(0.0, given / wanted) + gain / abs(wanted)
                    for given, wanted in zip(self._of_wheels(self._given), self._of_wheels(speeds)) if wanted),
                   default=1.0)

    def _of_wheels(self, speeds):
        return mix(*unmix(*speeds), self._separation) if self._separation else speeds


def make_ramp(parameters: Dict[str, object], driver: MotorDriver) -> Optional[Ramp]:
    """Return the Ramp that the parameters describe, for this board; None if its starts are not limited."""
    limit = parameters["acceleration_limit"]
    if not limit:
        return None
    return Ramp(limit, WHEEL_SEPARATION) if driver.closed_loop else Ramp(limit / parameters["max_speed"])
