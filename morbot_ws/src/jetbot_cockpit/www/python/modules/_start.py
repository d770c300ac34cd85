"""What every program sees: the page's print(), the program's clock, and no module that is of no use here."""

import builtins
import sys

import _clock  # noqa: F401
import _page
from _page import curve, drive, senses  # noqa: F401
from _page import show as _show
from _text import text as _text

MODULES = set("""
    __future__ array base64 binascii cmath collections copy datetime errno functools genpy geometry_msgs hashlib heapq
    io itertools json math nav_msgs numbers operator random re rospy sensor_msgs std_msgs string struct sys time types
    typing
""".split())
LONGEST = 10000  # characters of a line that has no end
NAMESPACE = _page.namespace().rstrip("/") + "/"  # of the robot's topics

_import = builtins.__import__
_unfinished = ""  # line


class NotHere(Exception):
    """A program asks for what the page does not have. Its message is the name of that alone."""


class NotHeard(Exception):
    """A program publishes, or waits to, on a topic that nothing in the page hears. Its message is the name alone."""


def lacking(module):
    """Return the __getattr__ of a module of which some names are not here."""
    def fail(name):
        if name.startswith("__"):
            raise AttributeError(name)
        raise NotHere(f"{module}.{name}")
    return fail


def show(*values, sep=" ", end="\n", file=None, flush=False):
    """Print as print() does. A name and a number are a value of a curve, too."""
    global _unfinished
    text = (" " if sep is None else sep).join([_text(each) for each in values]) + ("\n" if end is None else end)
    if file not in (None, sys.stdout, sys.stderr):
        file.write(text)
        return
    *lines, _unfinished = (_unfinished + text).split("\n")
    for line in lines:
        _show(line)
    if len(_unfinished) > LONGEST:
        finish_line()
    if len(values) == 2 and isinstance(values[0], str) and type(values[1]) in (int, float):
        curve(values[0], float(values[1]))  # a whole number would be cut to 32 bits


def finish_line():
    """Show a line that has no end yet."""
    global _unfinished
    if _unfinished:
        _show(_unfinished)
    _unfinished = ""


def finish():
    """End the program, whether it failed or not: its last functions run, its last line is shown."""
    try:
        if "rospy" in sys.modules:
            sys.modules["rospy"].signal_shutdown("atexit")
    finally:
        finish_line()


def open(*_, **__):
    raise NotHere("open()")


def input(*_):
    raise NotHere("input()")


def _import_for(name, names=None, *more):
    """Import for the program only what it can use; the modules themselves import what they need."""
    if names and names.get("__name__") == "__main__" and name.split(".")[0] not in MODULES:
        raise ImportError(f"no module named '{name}'")
    return _import(name, names, *more)


def start():
    """Prepare what the program sees."""
    for name in ("time", "math", "random"):
        sys.modules[name] = _import("_" + name)
    sys.argv[:] = ["program.py"]
    builtins.print, builtins.open, builtins.input, builtins.__import__ = show, open, input, _import_for
