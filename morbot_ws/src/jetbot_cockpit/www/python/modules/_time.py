"""Python's time, by the program's clock."""

from time import gmtime, localtime, mktime, strftime  # noqa: F401

import _clock

time = _clock.now


def sleep(seconds):
    if seconds < 0:
        raise ValueError("sleep length must be non-negative")
    _clock.wait(seconds)


def monotonic():
    """Return the time since the program's start, in s."""
    _clock.poll()
    return _clock.seconds()


perf_counter = process_time = monotonic


def time_ns():
    return int(time() * 1000000000)
