"""What the page makes of programs: what it does itself, and its Python, run without ROS."""

import json
import sys
from types import SimpleNamespace
from typing import Dict, List, Optional, Tuple

from javascript import node


def translate(programs: Optional[Dict[str, dict]]) -> Dict[str, dict]:
    """Return what the page does with each program: prints, commands, error; and its Python. None: the examples."""
    done = node("tests/js/translate.js", input=json.dumps(programs))
    assert done.returncode == 0, done.stdout
    return json.loads(done.stdout)


class End(Exception):
    """The program has run for long enough."""


class Twist:
    """geometry_msgs/Twist, as far as it is used here."""

    def __init__(self) -> None:
        self.linear, self.angular = SimpleNamespace(x=0.0), SimpleNamespace(z=0.0)


def run_python(source: str, monkeypatch) -> Tuple[List[str], List[List[float]]]:
    """Return what a node prints, and [time, x, z] of each command, with a rospy whose clock is turned by its sleeps."""
    prints, commands, clock = [], [], SimpleNamespace(now=0.0, ticked=0.0)

    def sleep(seconds):
        clock.now += max(0.0, seconds)
        if clock.now > 10.05:
            raise End

    def tick():
        behind = clock.now - clock.ticked - 0.1
        sleep(-behind)
        clock.ticked = clock.now if behind > 0.2 else clock.ticked + 0.1

    def publish(twist):
        commands.append([round(10 * clock.now), twist.linear.x, twist.angular.z])

    fake = SimpleNamespace(
        init_node=lambda name: None, Rate=lambda rate: SimpleNamespace(sleep=tick), sleep=sleep,
        get_time=lambda: clock.now,
        Publisher=lambda *_, **__: SimpleNamespace(publish=publish, get_num_connections=lambda: 1),
        is_shutdown=lambda: False, ROSInterruptException=End)
    monkeypatch.setitem(sys.modules, "rospy", fake)
    monkeypatch.setitem(sys.modules, "geometry_msgs.msg", SimpleNamespace(Twist=Twist))
    exec(compile(source, "program.py", "exec"), {"print": lambda value: prints.append(printed(value))})
    return prints, commands


def printed(value) -> str:
    """Return a value as the page prints it: numbers with six digits, large ones with all."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return str(value)
    return f"{value:.6g}" if abs(value) < 1e5 else f"{value:.15g}"


def changes(commands: List[List[float]]) -> List[List[float]]:
    """Return the commands, rounded, without those that repeat the one before; of several at a time the last one."""
    newest = {time: [round(value, 6) + 0.0 for value in values] for time, *values in commands}
    rows = [[time, *values] for time, values in newest.items()]
    return [row for row, before in zip(rows, [[None, 0.0, 0.0], *rows]) if row[1:] != before[1:]]
