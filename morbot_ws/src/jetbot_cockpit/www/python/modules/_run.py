"""Runs the program of the page, and says how it has ended."""

import io
import json
import sys

import _page
import _start
from _clock import names

SHOWN = bool, int, float, str, list, tuple, dict, set, type(None)
LONGEST = 100  # characters of a value, and parts of it


def each(line, values):
    """Mark this line before each of the values."""
    for value in values:
        _page.at(line)
        yield value


def run():
    """Run it until its end; a program that has failed says why."""
    names["_each"] = each
    _start.start()
    attempt(lambda: exec(compile(_page.program(), "program.py", "exec"), names))
    attempt(_start.finish)


def attempt(act):
    """Do this, and say why it fails."""
    try:
        act()
    except SystemExit:
        pass
    except BaseException as problem:
        trace = io.StringIO()
        sys.print_exception(problem, trace)
        _page.fail(type(problem).__name__, str(problem), trace.getvalue())


def shown(value):
    """Return a value as a text, of a long one its beginning."""
    if isinstance(value, (list, tuple)):
        value = value[:LONGEST]
    elif isinstance(value, (dict, set)) and len(value) > LONGEST:
        return "..."
    return repr(value)[:LONGEST]


def variables():
    """Return the program's variables and their values, as JSON."""
    return json.dumps([[name, shown(value)] for name, value in names.items()
                       if name[0] != "_" and isinstance(value, SHOWN)])
