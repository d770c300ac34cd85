"""The way of a robot whose board counts how far it came."""

import math
from collections import deque

COUNTER_RANGE = 65.536  # m and rad: after so much, int16 counters of mm and mrad begin anew
NEAR, FAR = 0.05, 0.3   # m and rad: from FAR off to NEAR the origin in one report no robot drives, but a board restarts
WINDOW = 0.04           # seconds, at least, over which speeds are taken: reports may arrive in bunches


class Track:
    """Adds up what the board counts, without a jump where its counters wrap or its board restarts.

    x, y: m; heading: rad, to the left; driven, turned: m and rad, the length of all ways and turns.
    """

    def __init__(self):
        self.x = self.y = self.heading = self.driven = self.turned = 0.0
        self._counted = None    # x, y, yaw by the board
        self._rotation = 0.0    # rad, from the board's axes to these
        self._ahead = 0.0       # m
        self._recent = deque()  # (seconds, m ahead, heading); the first is WINDOW old, or the oldest there is

    def add(self, x, y, yaw, now):
        """Go on to where the board is at the time ``now``, in seconds: x, y in m and yaw in rad, as it counts them."""
        last, self._counted = self._counted, (x, y, yaw)
        if last is None:
            self.x, self.y, self.heading = x, y, yaw
        elif began_anew(last, self._counted):
            self._rotation = self.heading - yaw
        else:
            self._go_on(least(x - last[0], COUNTER_RANGE), least(y - last[1], COUNTER_RANGE),
                        least(yaw - last[2], COUNTER_RANGE, 2 * math.pi))
        self._recent.append((now, self._ahead, self.heading))
        while len(self._recent) > 2 and now - self._recent[1][0] >= WINDOW:
            self._recent.popleft()

    def recent(self):
        """(seconds, m ahead, rad turned) of the last while, WINDOW long at least; None where it is not known yet."""
        (since, *before), (now, *after) = self._recent[0], self._recent[-1]
        return (now - since, *(b - a for a, b in zip(before, after))) if now - since >= WINDOW else None

    def _go_on(self, dx, dy, turn):
        middle = self.heading + turn / 2
        dx, dy = rotated(dx, dy, self._rotation)
        ahead, _ = rotated(dx, dy, -middle)
        self.x, self.y, self.heading = self.x + dx, self.y + dy, self.heading + turn
        self._ahead += ahead
        self.driven += abs(ahead)
        self.turned += abs(turn)


def began_anew(last, counted):
    """Whether the board restarted between these two counts of x, y, yaw."""
    return max(map(abs, last)) > FAR and max(map(abs, counted)) < NEAR


def least(change, *ranges):
    """A difference of two counts, of a counter that may have wrapped at one of these ranges."""
    return min((change + way * size for size in ranges for way in (0, -1, 1)), key=abs)


def rotated(x, y, angle):
    """The vector x, y, turned to the left by an angle in rad."""
    return x * math.cos(angle) - y * math.sin(angle), x * math.sin(angle) + y * math.cos(angle)
