"""What the wheels of all robots do, by the registers of their chips. Times are monotonic seconds."""

import contextlib
import threading
import time
from pathlib import Path
from typing import Dict, List, Optional, Sequence, Tuple

from jetbot.fake.motors import STOPPED, Motors

SAMPLE_INTERVAL = 0.005  # s
MAX_DELAY = 0.5          # s; after 0.8 s the same speed is sent again
Change = Tuple[float, Tuple[float, float]]  # when, and the speeds (left, right) from then on


class Wheels(threading.Thread):
    """Samples all wheels from its start to ``end``. buses: the folder of each robot's fake bus."""

    def __init__(self, buses: Dict[str, Path]):
        super().__init__(daemon=True)
        self._motors = {robot: Motors(bus) for robot, bus in buses.items()}
        self._changes: Dict[str, List[Change]] = {robot: [(0.0, STOPPED)] for robot in buses}
        self._ended = threading.Event()

    def run(self) -> None:
        while not self._ended.wait(SAMPLE_INTERVAL):
            for robot, motors in self._motors.items():
                speeds = STOPPED  # without a bus there is no power
                with contextlib.suppress(OSError):
                    speeds = motors.speeds()
                if speeds != self._changes[robot][-1][1]:
                    self._changes[robot].append((time.monotonic(), speeds))

    def end(self) -> None:
        self._ended.set()
        self.join()

    def turn(self, robot: str) -> bool:
        """Return whether a wheel of the robot turns now."""
        return self._changes[robot][-1][1] != STOPPED

    def turned(self, robot: str, since: float) -> bool:
        """Return whether a wheel of the robot has turned since this time."""
        return self.turn(robot) or self._changes[robot][-1][0] > since

    def stopped_at(self, robot: str) -> float:
        """Return when both wheels have stopped, infinity if one turns."""
        at, speeds = self._changes[robot][-1]
        return at if speeds == STOPPED else float("inf")

    def longest_command(self, since: float) -> float:
        """Return for how many s at most any robot has driven by one command since this time."""
        now = time.monotonic()
        return max((until - at for changes in self._changes.values() for (at, speeds), (until, _)
                    in zip(changes, [*changes[1:], (now, STOPPED)]) if at > since and speeds != STOPPED), default=0.0)

    def delays(self, robot: str, commands: Sequence[Tuple[float, float]]) -> List[float]:
        """Return in how many s the wheels have followed each command (when, speed), without those that were lost."""
        found = [self._delay(robot, at, speed) for at, speed in commands]
        return [delay for delay in found if delay is not None]

    def _delay(self, robot, sent_at, speed) -> Optional[float]:
        return next((at - sent_at for at, (left, _) in self._changes[robot]
                     if sent_at < at < sent_at + MAX_DELAY and abs(left - speed) < 0.004), None)


def p95(delays: Sequence[float]) -> float:
    """Return the 95th percentile."""
    return sorted(delays)[int(0.95 * len(delays))]
