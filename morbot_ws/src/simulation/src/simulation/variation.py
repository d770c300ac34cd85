"""How a simulated robot differs from its body, as no two real robots drive alike. No ROS."""

import random
from typing import NamedTuple

# The largest values, at a variation of 1; estimates for cheap gear motors on a classroom's floor.
GAIN, DEAD_BAND, SLIP, SAG = 0.05, 1.0, 0.03, 0.1


class Wheel(NamedTuple):
    """Factors of a motor's speed, of its dead band, and of the way that its wheel drives: a wheel slips."""

    gain: float = 1.0
    dead_band: float = 1.0
    grip: float = 1.0


class Variation(NamedTuple):
    """left, right: its wheels; sag: the share of the speed that is lost while both motors get full power."""

    left: Wheel = Wheel()
    right: Wheel = Wheel()
    sag: float = 0.0

    @property
    def controlled(self) -> "Variation":
        """What is left of it where a board controls the speeds of the wheels: they slip."""
        return Variation(Wheel(grip=self.left.grip), Wheel(grip=self.right.grip))


def draw(name: str, variation: float) -> Variation:
    """Return the variation of the robot with this name, always the same. variation: from 0 (none) to 1."""
    uniform = random.Random(name).uniform
    left, right = (Wheel(1 + variation * uniform(-GAIN, GAIN), 1 + variation * uniform(0, DEAD_BAND),
                         1 - variation * uniform(0, SLIP)) for _ in range(2))
    return Variation(left, right, variation * uniform(0, SAG))
