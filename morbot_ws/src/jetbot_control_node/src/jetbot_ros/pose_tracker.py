"""The way of a robot whose board counts how far it came."""

import math
from collections import deque

COUNTER_RANGE = 65.536  # m and rad: after so much, int16 counters of mm and mrad begin anew
NEAR = 0.1              # m and rad, from where the counters of a board begin that restarts
TOP_SPEED = (2, 2, 10)  # m/s, m/s and rad/s, which no JetBot reaches; faster, it is a restart
GAP = 0.12              # seconds: reports that are further apart tell no more of a restart than this
BUNCH = 0.01            # seconds within which reports count as one: the serial port may hold some back
WINDOW = 0.04           # seconds, at least, over which speeds are taken


class Track:
    """Adds up what the board counts, without a jump where its counters wrap or its board restarts.

    x, y: m; yaw: rad, to the left; driven, turned: m and rad, the length of all ways and turns.
    """

    def __init__(self):
        self.x = self.y = self.yaw = self.driven = self.turned = 0.0
        self._counted = None    # x, y, yaw by the board
        self._rotation = 0.0    # rad, from the board's axes to these
        self._ahead = 0.0       # m
        self._time = 0.0        # of the last report
        self._bunches = deque()  # [seconds, m ahead, yaw]; the first was WINDOW old when the last began
        self._recent = None

    def add(self, x, y, yaw, now):
        """Go on to where the board is at the time ``now``, in seconds: x, y in m and yaw in rad, as it counts them."""
        last, self._counted = self._counted, (x, y, yaw)
        if last is None:
            self.x, self.y, self.yaw = x, y, yaw
        elif began_anew(last, self._counted, now - self._time):
            self._rotation = self.yaw - yaw
        else:
            self._go_on(least(x - last[0], COUNTER_RANGE), least(y - last[1], COUNTER_RANGE),
                        least(yaw - last[2], COUNTER_RANGE, 2 * math.pi))
        self._time = now
        self._gather(now)

    def recent(self):
        """(seconds, m ahead, rad turned) of the last while, WINDOW long at least; None where it is not known yet."""
        return self._recent

    def _gather(self, now):
        if self._bunches and now - self._bunches[-1][0] < BUNCH:
            self._bunches[-1][1:] = self._ahead, self.yaw
            return
        if self._bunches:  # the last one is whole now
            while len(self._bunches) > 2 and self._bunches[-1][0] - self._bunches[1][0] >= WINDOW:
                self._bunches.popleft()
            seconds, *way = (b - a for a, b in zip(self._bunches[0], self._bunches[-1]))
            self._recent = (seconds, *way) if seconds >= WINDOW else None
        self._bunches.append([now, self._ahead, self.yaw])

    def _go_on(self, dx, dy, turn):
        middle = self.yaw + turn / 2
        dx, dy = rotated(dx, dy, self._rotation)
        ahead, _ = rotated(dx, dy, -middle)
        self.x, self.y, self.yaw = self.x + dx, self.y + dy, self.yaw + turn
        self._ahead += ahead
        self.driven += abs(ahead)
        self.turned += abs(turn)


def began_anew(last, counted, seconds):
    """Whether the board restarted between these two counts of x, y, yaw, so many seconds apart."""
    steps = (abs(b - a) - NEAR for a, b in zip(last, counted))
    return max(map(abs, counted)) < NEAR and any(step > top * min(seconds, GAP) for step, top in zip(steps, TOP_SPEED))


def least(change, *ranges):
    """A difference of two counts, of a counter that may have wrapped at one of these ranges."""
    return min((change + way * size for size in ranges for way in (0, -1, 1)), key=abs)


def rotated(x, y, angle):
    """The vector x, y, turned to the left by an angle in rad."""
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)
