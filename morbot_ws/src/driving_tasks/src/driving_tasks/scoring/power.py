"""Whether a robot that moves gets power for its wheels: no program moves it in the place of its simulator."""

from typing import Sequence

ROLLING = 50  # samples, of 1 s, in which a robot of the shipped size has long rolled out


class Power:
    """What its controller gives a robot's wheels, beside its motion. Until the controller says so, they have power."""

    def __init__(self):
        self._is_off, self._moved = False, 0

    def drive(self, wheels: Sequence[float]) -> None:
        """The controller gives the wheels these duties."""
        self._is_off = not any(wheels)
        self.command(wheels)

    def command(self, velocity: Sequence[float]) -> None:
        """Somebody commands this: short bursts of power, which the controller does not report, move a robot too."""
        if any(velocity):
            self._moved = 0

    def move(self) -> None:
        """The robot has moved from one sample to the next."""
        self._moved += self._is_off

    @property
    def is_missing(self) -> bool:
        """Whether the robot has moved on and on without power."""
        return self._moved > ROLLING
