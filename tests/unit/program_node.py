"""What the page makes of programs: what it does itself, and its Python, run without ROS."""

import io
import json
import math
import re
import sys
import traceback
import warnings
from contextlib import redirect_stdout
from decimal import ROUND_HALF_UP, Context, Decimal
from types import SimpleNamespace
from typing import Dict, List, NamedTuple, Optional

from javascript import node

MOST = 40000  # lines of a program that are run
SECONDS = 10.05  # that it runs
ROUNDED = ("sin", "cos", "tan", "asin", "acos", "atan", "exp", "log", "log10", "pow")


def translate(*choice: object, programs: Optional[dict] = None) -> Dict[str, dict]:
    """Return what the page does with each program, and its Python; see tests/js/translate.js."""
    done = node("tests/js/translate.js", *choice, input=json.dumps(programs))
    assert done.returncode == 0, done.stdout
    return json.loads(done.stdout)


class End(Exception):
    """The program has run for long enough."""


class Twist:
    """geometry_msgs/Twist, as far as it is used here."""

    def __init__(self) -> None:
        self.linear, self.angular = SimpleNamespace(x=0.0), SimpleNamespace(z=0.0)


class Time(float):
    """A time in s, which is a whole number of microseconds."""

    def __add__(self, other):
        return Time(round(float(self) + other, 6))

    def __sub__(self, other):
        return round(float(self) - other, 6)


class Run(NamedTuple):
    """What a node has printed and commanded, in its order; why it failed, and in which of its lines; if it went on."""

    trace: list
    error: Optional[Exception]
    lines: List[int]
    cut: bool


class Node:
    """A rospy whose clock is turned by its sleeps, and what else a node imports."""

    def __init__(self) -> None:
        self.trace, self.now, self.ticked, self.left, self.cut = [], Time(), Time(), MOST, False
        self.state = 1234567

    def sleep(self, seconds):
        self.now += max(0.0, seconds)
        if self.now > SECONDS:
            self.end()

    def end(self):
        self.cut = True
        raise End

    def tick(self):
        behind = self.now - self.ticked - 0.1
        self.sleep(-behind)
        self.ticked = self.now if behind > 0.2 else self.ticked + 0.1

    def publish(self, twist):
        self.trace.append([round(1000 * self.now), float(twist.linear.x), float(twist.angular.z)])

    def random(self):
        """Return a number in [0, 1), of the same stream as in tests/js/translate.js."""
        self.state = self.state * 16807 % 2147483647
        return self.state / 2147483647

    def randint(self, low, high):
        """Return a whole number from low to high."""
        return low + math.floor(self.random() * (high - low + 1))

    def modules(self):
        """Return what stands for each module that a node imports."""
        odom = SimpleNamespace(pose=SimpleNamespace(pose=SimpleNamespace(
            position=SimpleNamespace(x=1.0, y=2.0), orientation=SimpleNamespace(z=0.0, w=1.0))))
        messages = {"odom": odom, "line": SimpleNamespace(data=[0.25, 0.5, 1])}
        rospy = SimpleNamespace(
            init_node=lambda name: None, Rate=lambda rate: SimpleNamespace(sleep=self.tick), sleep=self.sleep,
            Publisher=lambda *_, **__: SimpleNamespace(publish=self.publish, get_num_connections=lambda: 1),
            wait_for_message=lambda topic, *_: messages[topic], Subscriber=lambda *_: None, get_time=lambda: self.now,
            is_shutdown=lambda: False, ROSInterruptException=End)
        return {"rospy": rospy, "geometry_msgs.msg": SimpleNamespace(Twist=Twist, Pose2D=SimpleNamespace),
                "nav_msgs.msg": SimpleNamespace(Odometry=None), "std_msgs.msg": SimpleNamespace(Float32MultiArray=None),
                "random": SimpleNamespace(random=self.random, randint=self.randint),
                "math": SimpleNamespace(**{**vars(math), **{name: rounded(vars(math)[name]) for name in ROUNDED}})}

    def count(self, frame, event, _):
        """Trace the lines of the program alone, and end it after many."""
        if frame.f_code.co_filename != "program.py":
            return None
        self.left -= event == "line"
        return self.count if self.left else self.end()


def rounded(function):
    """Return a function of ``math`` that calculates with 12 digits: the last ones are the C library's own."""
    return lambda *given: float(f"{function(*given):.12g}")


def run_python(source: str) -> Run:
    """Run a node without ROS."""
    ros = Node()
    names = {"print": lambda *values: ros.trace.append(" ".join(map(printed, values))), "str": printed,
             "__name__": "program"}
    before, deepest, error = {name: sys.modules.get(name) for name in ros.modules()}, sys.getrecursionlimit(), None
    sys.modules.update(ros.modules())
    sys.setrecursionlimit(len(traceback.extract_stack()) + 1001)  # as of a program; one more is the tracer's
    try:
        sys.settrace(ros.count)
        exec(compile(source, "program.py", "exec"), names)
    except Exception as failure:
        error = failure
    finally:
        sys.settrace(None)
        sys.setrecursionlimit(deepest)
        for name in before:
            del sys.modules[name]
        sys.modules.update({name: module for name, module in before.items() if module})
    return Run(ros.trace, error, lines_of(error), ros.cut)


def run_text(source: str, names: Optional[dict] = None) -> Run:
    """Run a text as Python itself does, with these names; its trace is what it prints."""
    written, error = io.StringIO(), None
    with redirect_stdout(written), warnings.catch_warnings():
        try:
            warnings.simplefilter("ignore")  # what is wrong on purpose
            exec(compile(source, "program.py", "exec"), {"__name__": "__main__", **(names or {})})
        except Exception as failure:
            error = failure
    *prints, last = written.getvalue().split("\n")
    lines = [error.lineno] if isinstance(error, SyntaxError) else lines_of(error)
    return Run(prints + [last] * bool(last), error, lines, False)


def lines_of(error: Optional[Exception]) -> List[int]:
    """Return the lines of the program that led to this error, from 1, the innermost one last."""
    frames = traceback.walk_tb(error.__traceback__ if error else None)
    return [line for frame, line in frames if frame.f_code.co_filename == "program.py"]


def printed(value) -> str:
    """Return a value as the page prints it: numbers with six digits, large ones with 15."""
    if isinstance(value, bool) or not isinstance(value, (int, float)) or not math.isfinite(value):
        return str(value)
    digits = Context(prec=6 if abs(value) < 1e5 else 15, rounding=ROUND_HALF_UP)
    short = value if value == int(value) else float(digits.create_decimal(value))
    if short == int(short):
        return str(int(short))
    return f"{Decimal(repr(short)):f}" if abs(short) >= 1e-6 else re.sub("e-0", "e-", repr(short))
