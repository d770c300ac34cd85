"""rospy's messages for a person, as a terminal shows them, but without the time."""

from _clock import seconds
from _start import show

from .core import log_level

DEBUG, INFO, WARN, ERROR, FATAL = 1, 2, 4, 8, 16
LEVELS = [("debug", DEBUG, "DEBUG"), ("info", INFO, "INFO"), ("warn", WARN, "WARN"), ("err", ERROR, "ERROR"),
          ("fatal", FATAL, "FATAL")]

_last = {}  # when each sentence was said last, in s, and its text


def functions():
    """Return loginfo, loginfo_throttle ... by their names."""
    made = {}
    for name, number, label in LEVELS:
        made["log" + name] = log = _logger(number, label)
        made[f"log{name}_once"] = _once(log)
        made[f"log{name}_throttle"] = _throttle(log, False)
        made[f"log{name}_throttle_identical"] = _throttle(log, True)
    return made


def _logger(number, label):
    def log(message, *args, **_):
        if number >= (log_level() or INFO):
            show(f"[{label}]: {message % args if args else message}")
    return log


def _once(log):
    def once(message, *args, **_):
        if _key(log, message) not in _last:
            _last[_key(log, message)] = seconds(), message
            log(message, *args)
    return once


def _throttle(log, identical):
    def throttle(period, message, *args, **_):
        said_at, said = _last.get(_key(log, message), (None, None))
        if said_at is None or seconds() - said_at >= period or identical and said != message:
            _last[_key(log, message)] = seconds(), message
            log(message, *args)
    return throttle


def _key(log, message):
    """Return what a place in the program says, whatever its numbers are: MicroPython does not know who calls."""
    return log, "".join([each for each in str(message) if not each.isdigit() and each not in "-."])
