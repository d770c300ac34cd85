"""The simulated time: steps of exactly 10 ms, each with a stamp. No ROS, and no clock of its own."""

STEP = 0.01                     # s
NANOSECONDS = 10_000_000        # of a step
MAX_STEPS = 100                 # at once: after a pause, the simulation catches up, and still obeys new commands
CLOCK_WAS_SET = 1_000_000_000   # ns between the stamps and the computer's clock: it is another time now


class StepClock:
    """Counts steps. now: a monotonic clock's time; stamp: the computer's at the same moment, both in ns.

    steps: how many were due since the start; stamp: of the last of them, in ns.
    """

    def __init__(self, now: int, stamp: int):
        self._started, self._first_stamp = now, stamp
        self.steps = 0

    @property
    def stamp(self) -> int:
        """The time of the last step, in ns: whole steps after the start."""
        return self._first_stamp + self.steps * NANOSECONDS

    def update(self, now: int, stamp: int) -> int:
        """Return how many steps are due, MAX_STEPS at most; the others are due in the next calls.

        The stamps follow the computer's clock only where that is set.
        """
        missing = (now - self._started) // NANOSECONDS - self.steps
        due = min(missing, MAX_STEPS)
        self.steps += due
        if due == missing and abs(stamp - self.stamp) > CLOCK_WAS_SET:
            self._first_stamp += stamp - self.stamp
        return due

    def remaining(self, now: int, steps: int) -> float:
        """Return the time in s until the next multiple of so many steps is due."""
        interval = steps * NANOSECONDS
        return (interval - (now - self._started) % interval) / 1e9
