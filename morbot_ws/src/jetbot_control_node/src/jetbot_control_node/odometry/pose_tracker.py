"""The pose of a robot whose board counts how far it moved."""

import math
from collections import deque
from typing import Optional, Tuple

from jetbot.kinematics import Pose, from_frame, to_frame

COUNTER_RANGE = 0x10000  # mm and mrad after which the board's int16 counters wrap
YAW_RANGE = 2000 * math.pi  # mrad: a board may also wrap its yaw at a full turn
RESTART_RANGE = 100      # mm and mrad: the counters of a board that has just restarted are below
MAX_RATES = (2000, 2000, 10000)  # mm/s, mm/s and mrad/s, which no JetBot reaches; a faster change is a restart
MAX_GAP = 0.12           # s: a longer gap in the telemetry says no more about a restart
BURST_INTERVAL = 0.01    # s within which telemetry frames count as one: the serial port may hold some back
WINDOW = 0.04            # s, at least, over which velocities are averaged

Counts = Tuple[int, int, int]  # x, y in mm; yaw in mrad


class PoseTracker:
    """Adds up what the board counts, without a jump when its counters wrap or it restarts.

    x, y: m; yaw: rad, to the left, unbounded; path_length, total_rotation: in sum, m and rad;
    velocity: forward in m/s, to the left in rad/s, over the last ``WINDOW`` or longer.
    drift: the error of a path or a rotation, as a fraction of it; an estimate for uncalibrated encoders.
    """

    drift = 0.05

    def __init__(self):
        self.x = self.y = self.yaw = 0.0
        self.path_length = self.total_rotation = 0.0
        self.velocity = 0.0, 0.0
        self._counts: Optional[Counts] = None
        self._updated_at = 0.0
        self._rotation = 0.0     # rad, from the board's axes to these
        self._forward = 0.0      # m, in sum
        self._samples = deque()  # [seconds, forward, yaw], one per burst

    def update(self, counts: Counts, now: float) -> None:
        """Advance to the board's counts of x, y, yaw at the time ``now``, in seconds."""
        last, self._counts = self._counts, counts
        if last is None:
            self.x, self.y, self.yaw = (count / 1000 for count in counts)
        elif counters_reset(last, counts, now - self._updated_at):
            self._rotation = self.yaw - counts[2] / 1000
        else:
            dx, dy, turn = (new - old for old, new in zip(last, counts))
            self._integrate(unwrap(dx) / 1000, unwrap(dy) / 1000, unwrap_yaw(turn) / 1000)
        self._updated_at = now
        self._append_sample(now)

    def _integrate(self, dx, dy, turn):
        dx, dy = from_frame(Pose(yaw=self._rotation), (dx, dy))
        forward, _ = to_frame(Pose(yaw=self.yaw + turn / 2), (dx, dy))
        self.x, self.y, self.yaw = self.x + dx, self.y + dy, self.yaw + turn
        self._forward += forward
        self.path_length += abs(forward)
        self.total_rotation += abs(turn)

    def _append_sample(self, now):
        samples = self._samples
        if samples and now - samples[-1][0] < BURST_INTERVAL:
            samples[-1][1:] = self._forward, self.yaw
            return
        if samples:  # the last burst is complete now
            while len(samples) > 2 and samples[-1][0] - samples[1][0] >= WINDOW:
                samples.popleft()
            seconds, forward, turn = (last - first for first, last in zip(samples[0], samples[-1]))
            if seconds >= WINDOW:
                self.velocity = forward / seconds, turn / seconds
        samples.append([now, self._forward, self.yaw])


def counters_reset(last: Counts, counts: Counts, seconds: float) -> bool:
    """Return whether the board restarted between these two counts, which are ``seconds`` apart."""
    jumps = (abs(new - old) - RESTART_RANGE for old, new in zip(last, counts))
    return max(map(abs, counts)) < RESTART_RANGE and any(
        jump > rate * min(seconds, MAX_GAP) for jump, rate in zip(jumps, MAX_RATES))


def unwrap(difference: int) -> int:
    """Return the difference of two int16 counts, of a counter that may have wrapped once."""
    return (difference + COUNTER_RANGE // 2) % COUNTER_RANGE - COUNTER_RANGE // 2


def unwrap_yaw(difference: int) -> float:
    """Return the difference of two yaws, of a counter that may wrap as an int16 or at a full turn."""
    return min(unwrap(difference), math.remainder(difference, YAW_RANGE), key=abs)
