"""What every program of the page finds."""

import builtins

import _page


def show(*values, sep=" ", end="\n", **_):
    """Print as Python does, on the page; a name and a number are a point of a curve."""
    _page.show(sep.join(str(each) for each in values))


def end():
    """End what the program has begun."""


builtins.print = show
