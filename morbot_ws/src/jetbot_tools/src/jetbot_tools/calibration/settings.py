"""The file in which the calibration keeps a robot's parameters."""

import json
import os
import shlex
from pathlib import Path
from typing import Any, Mapping, Optional

from jetbot import JetbotError, files
from jetbot.host import in_shell
from jetbot.text import printable
from jetbot_control_node.parameters import PARAMETERS, default_file

from ..options import launch_command

BODY_HEADER = "# Made by calibrate.py: how the robot drives without its corrections, for the simulation."
HEADER = "# Made by calibrate.py for one robot; the controller loads it. Without this file, the defaults apply."
IN_METRES = "# With it, the robot obeys metres and radians: linear.x is in m/s, angular.z in rad/s."
IN_METRES_ONLY = "# With it, linear.x is in m/s, but angular.z is not in rad/s: wheel_separation is not measured."


def output_file(file: Optional[Path], simulated: bool) -> Path:
    """Return the file to write, the default if ``file`` is None; raise JetbotError if it cannot be written."""
    file = file or default_file().with_name("jetbot_fake.yaml" if simulated else "jetbot.yaml")
    if simulated and os.path.realpath(file) == os.path.realpath(default_file()):
        raise JetbotError(f"{file} is for the real robot, and this one is simulated", "Name another with --output.")
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
        files.check_writable(file)
        if file.exists():
            files.read(file)  # as ``files.keep`` will
    except OSError as error:
        raise JetbotError(f"the file {file} cannot be written: {error.strerror}",
                          "Name another with --output.") from None
    return file


def as_yaml(values: Mapping[str, Any]) -> str:
    """Return parameters as a YAML file with the meaning of each as a comment."""
    lines = [HEADER]
    if "max_speed" in values:
        lines.append(IN_METRES if "wheel_separation" in values else IN_METRES_ONLY)
    lines += [f"{name}: {json.dumps(values[name])}  # {row.doc}" for name, row in PARAMETERS.items() if name in values]
    return "\n".join(lines) + "\n"


def write(file: Path, text: str, usage: str) -> None:
    """Write the text, keep an older file under another name, and print how to undo this, and a sentence on its use."""
    old = files.keep(file)
    files.replace(file, text.encode())
    undo = ["mv", str(old), str(old.with_suffix(""))] if old else ["rm", str(file)]
    print(printable(f"Written to {file}. To undo it: {shlex.join(undo)}"))
    print(printable(usage))


def write_all(file: Path, parameters: Mapping[str, Any], body: Mapping[str, Any]) -> None:
    """Write the parameters for the controller, and the body for the simulation into a file beside it."""
    command = launch_command(config=file.absolute())
    write(file, as_yaml(parameters),
          "The controller uses it from now on." if file == default_file() else f"To use it: {command}")
    body_file = file.with_name(f"{file.stem}_body.yaml")
    command = in_shell(shlex.join(["roslaunch", "simulation", "simulation.launch", f"config:={file.absolute()}",
                                   f"body:={body_file.absolute()}"]))
    write(body_file, "\n".join([BODY_HEADER, *(f"{name}: {json.dumps(value)}" for name, value in body.items()), ""]),
          f"To simulate this robot: {command}")
