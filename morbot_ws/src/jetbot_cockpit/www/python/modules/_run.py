"""Runs the program of the page, and says how it has ended."""

import io
import json
import sys

import _clock
import _dialect
import _page
import _start
from _clock import mark, names
from _text import represented

BRACKETS = {list: "[]", tuple: "()", set: "{}", dict: "{}"}
SHOWN = (bool, int, float, str, type(None)) + tuple(BRACKETS)
LONGEST = 100  # characters of a value
MOST = 100  # variables
HUGE = 10 ** LONGEST  # its digits take long


def each(line, values):
    """Mark this line before each of the values."""
    for value in values:
        mark(line)
        yield value


def run():
    """Run it until its end; a program that has failed says why."""
    names.update(_dialect.names, _each=each)
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
        _page.fail(type(problem).__name__, *described(problem))


def described(problem):
    """Return an exception's message and traceback; both are empty if the program's own code fails to say them."""
    trace = io.StringIO()
    try:
        sys.print_exception(problem, trace)
        return str(problem), trace.getvalue()
    except BaseException:
        return "", ""


def shown(value, room=LONGEST):
    """Return a value as a text, of a long one its beginning. It runs nothing of the program's own code."""
    kind = type(value)
    if room == 0 or kind not in SHOWN or kind is int and not -HUGE < value < HUGE:
        return "..."
    if kind is str:
        return represented(value[:room])
    return listed(value, BRACKETS[kind], room) if kind in BRACKETS and value else repr(value)


def listed(values, brackets, room):
    """Return the items of a list, a tuple, a set or a dict as a text."""
    parts = []
    for each in values.items() if type(values) is dict else values:
        if sum(map(len, parts)) > room:
            parts.append("...")
            break
        pair = each if type(values) is dict else (each,)
        parts.append(": ".join([shown(part, room // 2) for part in pair]))
    end = "," if type(values) is tuple and len(values) == 1 else ""
    return brackets[0] + ", ".join(parts) + end + brackets[1]


def variables():
    """Return the variables of the function that runs, and the program's, with their values, as JSON."""
    local = _clock.local
    seen = [(name, value) for each in (local, names) for name, value in each.items()
            if type(name) is str and name[:1] not in ("", "_") and type(value) in SHOWN
            and (each is local or name not in local)]
    return json.dumps([[name[:LONGEST], shown(value)[:LONGEST]] for name, value in seen[:MOST]])
