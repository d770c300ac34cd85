"""Programs of blocks: how a test writes them, runs them in the page, and runs the Python that the page makes."""

import json
import sys
from types import SimpleNamespace
from typing import Any, Dict, List, Optional, Tuple

from geometry_msgs.msg import Twist

# Runs a program without a robot, by a clock that is turned by hand. Returns what it prints, and [time, x, z] of each
# command that is not the one before.
INTERPRET = """const [program, senses, done] = arguments;
Promise.all([import('/program/interpreter.js'), import('/program/python.js'), import('/program/editor.js')]).then(
([{ Interpreter }, { toPython }]) => {
    const geometry = { wheel_separation: 2, max_speed: 1 };
    const [prints, commands] = [[], []];
    let [now, ticked, steps, error] = [0, 0, 0, ""];
    const interpreter = new Interpreter(program, geometry, () => ({ seconds: now / 10, ...senses }));
    try {
        for (const event of interpreter.run()) {
            if ((steps += 1) > 20000 || now > 100) break;
            if ("print" in event) prints.push(event.print);
            if ("step" in event || "print" in event || "breathe" in event) continue;
            commands.push([Math.round(now), ...interpreter.motion]);
            if (event.wait > 0) now += 10 * event.wait;
            if (event.tick) [now, ticked] = [Math.max(now, ticked + 1), now - ticked > 3 ? now : ticked + 1];
        }
    } catch (problem) { error = problem.message; }
    done({ prints, commands, error, steps });
})"""
TO_PYTHON = """const done = arguments[arguments.length - 1];
import('/program/python.js').then(({ toPython }) => {
    const workspace = new Blockly.Workspace();
    Blockly.serialization.workspaces.load(arguments[0], workspace);
    done(toPython(workspace, 'my_program', { wheel_separation: 2, max_speed: 1 }).text);
})"""


def num(value: float) -> dict:
    """Return an input with a number."""
    return {"block": {"type": "math_number", "fields": {"NUM": value}}}


def block(kind: str, fields: Optional[dict] = None, **inputs: dict) -> dict:
    """Return a block with these inputs."""
    return {"type": kind, "fields": fields or {}, "inputs": inputs}


def plug(kind: str, fields: Optional[dict] = None, **inputs: dict) -> dict:
    """Return an input with such a block."""
    return {"block": block(kind, fields, **inputs)}


def chain(*blocks: dict) -> dict:
    """Return an input with these statements, one below the other."""
    below = None
    for each in reversed(blocks):
        below = {"block": {**each, **({"next": below} if below else {})}}
    return below


def program(*blocks: dict, functions: Tuple[dict, ...] = (), variables: str = "") -> dict:
    """Return a program. variables: their names, of one letter each, which are their ids."""
    start = {"type": "robot_start", "x": 20, "y": 20, **({"next": chain(*blocks)} if blocks else {})}
    return {"blocks": {"languageVersion": 0, "blocks": [start, *functions]},
            "variables": [{"name": name, "id": name} for name in variables]}


def show(value: dict) -> dict:
    """Return a block that prints this input."""
    return block("robot_print", VALUE=value)


def let(name: str, value: dict) -> dict:
    """Return a block that sets a variable."""
    return block("variables_set", {"VAR": {"id": name}}, VALUE=value)


def var(name: str) -> dict:
    """Return an input with a variable."""
    return plug("variables_get", {"VAR": {"id": name}})


def drive(x: float, seconds: float) -> dict:
    """Return a block that drives straight."""
    return block("robot_drive", X=num(x), SECONDS=num(seconds))


def set_motion(x: float, z: float) -> dict:
    """Return a block that sets x and z."""
    return block("robot_set", X=num(x), Z=num(z))


def wait(seconds: float) -> dict:
    """Return a block that waits."""
    return block("robot_wait", SECONDS=num(seconds))


def calculate(operator: str, left: dict, right: dict) -> dict:
    """Return an input with an arithmetic operation."""
    return plug("math_arithmetic", {"OP": operator}, A=left, B=right)


def interpret(page, blocks: dict, senses: Optional[Dict[str, Any]] = None) -> dict:
    """Return what the page's interpreter does with a program: prints, commands, error and steps."""
    return page.driver.execute_async_script(INTERPRET, blocks, senses or {})


def python_of(page, blocks: dict) -> str:
    """Return the Python that the page makes of a program."""
    return page.driver.execute_async_script(TO_PYTHON, blocks)


class End(Exception):
    """The program has run for long enough."""


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

    def publish(twist: Twist):
        commands.append([round(10 * clock.now), twist.linear.x, twist.angular.z])

    fake = SimpleNamespace(
        init_node=lambda name: None, Rate=lambda rate: SimpleNamespace(sleep=tick), sleep=sleep,
        get_time=lambda: clock.now,
        Publisher=lambda *_, **__: SimpleNamespace(publish=publish, get_num_connections=lambda: 1),
        is_shutdown=lambda: False, ROSInterruptException=End)
    monkeypatch.setitem(sys.modules, "rospy", fake)
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


def as_file(folder, blocks) -> str:
    """Write a program, or a text, into a file; return its path."""
    file = folder / "program.json"
    file.write_text(blocks if isinstance(blocks, str) else json.dumps(blocks))
    return str(file)
