#!/usr/bin/env python3
"""Write the tables of tasks and of parameters into the docs, and the parameters into the launch files, from their rows.

Run it after a change to TASKS or PARAMETERS: ./morbot shell docs/tables.py
"""

import re
from functools import partial
from pathlib import Path
from typing import Iterable
from xml.sax.saxutils import quoteattr

from driving_tasks.scoring.tasks import TASKS
from jetbot_camera.camera_parameters import PARAMETERS as CAMERA
from jetbot_control_node.parameters import PARAMETERS as CONTROLLER

ROOT = Path(__file__).parents[1]
PACKAGES = ROOT / "morbot_ws/src"


def replaced(text: str, start: str, end: str, lines: Iterable[str]) -> str:
    """Return a text with these lines in place of those from the first ``start`` to the next ``end``, both patterns."""
    return re.sub(rf"^ *{start}.*?(?=^ *{end})", lambda _: "".join(f"{line}\n" for line in lines), text, count=1,
                  flags=re.M | re.S)


def row(*cells: str) -> str:
    """Return a row of a table in Markdown."""
    return "".join(f"| {cell} " if cell else "| " for cell in cells) + "|"


def default_of(name: str, value: object) -> str:
    """Return a default as YAML and roslaunch write it."""
    if value is None or value == "":
        return "JETBOT_CAMERA, or csi" if name == "source" else "the board's own"
    return str(value).lower() if isinstance(value, bool) else str(value)


def launch_file(parameters: dict, text: str) -> str:
    """Return a launch file with an argument and a parameter for each row."""
    docs = {name: f"{each.doc} ({' '.join(filter(None, (default_of(name, each.default), each.unit)))})"
            for name, each in parameters.items()}
    text = replaced(text, '<arg name="', '<arg name="(?:config|robot_name)"', (
        f'  <arg name="{name}" default="" doc={quoteattr(doc)}/>' for name, doc in docs.items()))
    return replaced(text, '<param name="', '(?:<param name="config"|</node>)', (
        f'    <param name="{name}" value="$(arg {name})"/>' for name in docs))


def reference(text: str) -> str:
    """Return docs/reference.md with the rows of the camera and of the controller."""
    for parameters, ending in (CAMERA, ":="), (CONTROLLER, ""):
        first = next(iter(parameters))
        text = replaced(text, rf"\| `{first}{ending}` \|", r"$", (
            row(f"`{name}{ending}`", f"`{default_of(name, each.default)}`", each.unit, each.doc)
            for name, each in parameters.items()))
    return text.replace("`JETBOT_CAMERA, or csi`", "`csi`, or JETBOT_CAMERA")


def names(functions: Iterable) -> str:
    return ", ".join((each.func if isinstance(each, partial) else each).__name__ for each in functions)


def tasks(text: str) -> str:
    """Return docs/tasks.md with a row for each task."""
    return replaced(text, r"\| `metre` \|", r"$", (
        row(f"`{name}`", task.instruction, f"{task.ideal_seconds:.2f} s", names(task.measures), names(task.penalties))
        for name, task in TASKS.items()))


GENERATED = {ROOT / "docs/reference.md": reference, ROOT / "docs/tasks.md": tasks,
             PACKAGES / "jetbot_camera/launch/camera.launch": partial(launch_file, CAMERA),
             PACKAGES / "jetbot_control_node/launch/jetbot_controller.launch": partial(launch_file, CONTROLLER)}

if __name__ == "__main__":
    for file, written in GENERATED.items():
        file.write_text(written(file.read_text()))
