"""Waiting: rospy's Rate, Timer and sleep, with its arithmetic."""

import _clock
from genpy import Duration, Time

from .core import check_time, is_shutdown


def get_rostime():
    check_time()
    return Time.now()


def get_time():
    return get_rostime().to_sec()


def sleep(duration):
    """Wait so many s, or a Duration; not at all if it is negative."""
    check_time()
    _clock.wait(duration.to_sec() if isinstance(duration, Duration) else duration)


def spin():
    check_time()
    while not is_shutdown():
        _clock.wait(0.1)


class Rate:
    def __init__(self, hz, reset=False):
        self.last_time, self.sleep_dur = get_rostime(), Duration(0, int(1e9 / hz))

    def remaining(self):
        return self._remaining(get_rostime())

    def sleep(self):
        now = get_rostime()
        sleep(self._remaining(now))
        self.last_time += self.sleep_dur
        if now - self.last_time > self.sleep_dur * 2:  # the loop is too slow for this rate
            self.last_time = now

    def _remaining(self, now):
        return self.sleep_dur - (now - self.last_time)


class TimerEvent:
    def __init__(self, last_expected, last_real, current_expected, current_real, last_duration):
        self.last_expected, self.last_real = last_expected, last_real
        self.current_expected, self.current_real = current_expected, current_real
        self.last_duration = last_duration


class Timer:
    def __init__(self, period, callback, oneshot=False, reset=False):
        self._period, self._callback, self._oneshot = period.to_sec(), callback, oneshot
        self._due, self._runs = _clock.seconds() + self._period, False
        self._last = None, None, None  # when it was to run, when it ran, and for how long
        _clock.add(self)

    def shutdown(self):
        if self in _clock.tasks:
            _clock.tasks.remove(self)

    def patience(self):
        """Return how long this can wait, in s."""
        return 0.1 if self._runs else min(0.1, max(0, self._due - _clock.seconds()))

    def run(self):
        """Run the callback if it is due; when several are, once."""
        now = _clock.seconds()
        if self._runs or now < self._due - 1e-6:
            return
        expected, real = Time(Time.now().to_sec() - now + self._due), Time.now()
        self._due = now + self._period if now - self._due > self._period else self._due + self._period
        if self._oneshot:
            self.shutdown()
        self._runs = True
        try:
            self._callback(TimerEvent(*self._last[:2], expected, real, self._last[2]))
        finally:
            self._runs = False
        self._last = expected, real, _clock.seconds() - now
