"""An independent record of what the wheels do: a thread polls the registers of the chips on the fake buses.

It also sees when this computer is too busy for a test that drives.
"""

import math
import threading
import time
from contextlib import suppress
from pathlib import Path
from typing import Dict, List, NamedTuple, Optional, Tuple

from jetbot.fake.motors import STOPPED, Motors

POLL_INTERVAL = 0.005  # s
WRITING = 0.03  # s from one wheel's write to the other's, much less than between two commands
PAUSE = 0.1  # s; a thread that was not scheduled for so long shows that the computer is too busy
LOOK_INTERVAL = 0.1  # s between two looks at the watched process

Speeds = Tuple[float, float]  # left, right


class Change(NamedTuple):
    """At this time, in s since the epoch, the wheels were seen to turn at other speeds than before."""

    time: float
    speeds: Speeds


class WheelRecord:
    """Polls the chips until ``close``. folders: of the fake buses, by robot.

    watched: the id of the process whose pauses count beside this one's; paused_at: when one of them has last paused.
    """

    def __init__(self, folders: Dict[str, Path]):
        self._changes: Dict[str, List[Change]] = {robot: [Change(time.time(), STOPPED)] for robot in folders}
        self._motors = {robot: Motors(folder) for robot, folder in folders.items()}
        self.paused_at, self.watched = 0.0, None
        self._waited = self._looked_at = 0.0
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._poll, daemon=True)
        self._thread.start()

    def speeds(self, robot: str) -> Speeds:
        """Return the speeds of a robot's wheels."""
        return self._changes[robot][-1].speeds

    def since(self, robot: str, start: float) -> List[Change]:
        """Return the robot's changes after this time."""
        return [change for change in self._changes[robot] if change.time > start]

    def driven(self, robot: str, start: float) -> List[Speeds]:
        """Return the speeds of both wheels since this time; not while one was set already, and the other not yet."""
        changes = self.since(robot, start)
        ends = [*(change.time for change in changes[1:]), math.inf]
        return [change.speeds for change, end in zip(changes, ends) if end - change.time > WRITING]

    def close(self) -> None:
        """End the thread."""
        self._over.set()
        self._thread.join()

    def _poll(self):
        last = time.time()
        while not self._over.wait(POLL_INTERVAL):
            now = time.time()
            if now - last > PAUSE or self._watched_paused(now):
                self.paused_at = now
            last = now
            for robot, motors in self._motors.items():
                speeds = motors.speeds()
                if speeds != self._changes[robot][-1].speeds:
                    self._changes[robot].append(Change(time.time(), speeds))

    def _watched_paused(self, now):
        if now - self._looked_at < LOOK_INTERVAL:
            return False
        before, self._waited, self._looked_at = self._waited, waiting_time(self.watched), now
        return self._waited - before > PAUSE


def waiting_time(process: Optional[int]) -> float:
    """Return for how many s the threads of a process have waited for a processor so far."""
    waited = 0
    for file in Path(f"/proc/{process}/task").glob("*/schedstat"):
        with suppress(OSError):  # it has just ended
            waited += int(file.read_text().split()[1])
    return waited / 1e9
