"""Checks of the computer: its Python modules, other programs in the way, and the supply that it measures."""

import importlib.util
import os
from pathlib import Path
from typing import List, NamedTuple, Union

from jetbot import host
from jetbot.errors import JetbotError
from jetbot.i2c import I2CDevice
from jetbot.serial_link import SerialLink
from jetbot.supply import find_supply
from jetbot.text import printable
from jetbot_ros.contract import COCKPIT_PORT
from jetbot_ros.ports import is_free, processes_on

NOETIC = Path("/opt/ros/noetic")


class Check(NamedTuple):
    """The result of one check: whether it is as it should be, what was found, and what to do about it."""

    name: str
    ok: bool
    finding: str
    advice: str = ""
    command: str = ""  # starts the robot that the check has found
    condition: str = ""  # what must be true of that robot, which no program can find out; else it must not be driven

    def __str__(self) -> str:
        return printable(f"{'ok' if self.ok else 'NOT':<4}{self.name}: {self.finding}. {self.advice}".rstrip())


def check_module(module: str) -> Check:
    """Check that a Python module is installed."""
    if importlib.util.find_spec(module):
        return Check(module, True, "installed")
    return Check(module, False, "not installed", install_advice(module))


def install_advice(module: str, noetic: Path = NOETIC) -> str:
    """Return how to install a Python module, on Ubuntu 20.04 with Noetic or on a system that has ROS itself."""
    package = module.replace("_", "-")
    if not noetic.exists() or module in ("serial", "yaml", "tornado"):
        return f"Install it with: sudo apt install python3-{package}"
    if module == "smbus2":
        return "Install it with: pip3 install smbus2"
    return f"Type: source {noetic}/setup.bash   Or install it with: sudo apt install ros-noetic-{package}"


def check_host() -> Check:
    """Report which computer this is, and which bus its robot is on."""
    model = host.model()
    bus = host.robot_bus(model)
    where = f", whose motors are on /dev/i2c-{bus}" if bus is not None else ""
    return Check("computer", True, f"{model}{where}" or "not one of those that a JetBot carries")


def check_users(device: str, proc: Path = Path("/proc")) -> List[Check]:
    """Check that no other program has a device open, as far as this user may see; [] if there is no such device.

    The JetBot's display service is no fault: the kernel sends each transfer as a whole.
    """
    if not os.path.exists(device):
        return []
    users = [pid for pid in host.processes_with({os.path.realpath(device)}, proc) if pid != os.getpid()]
    others = [pid for pid in users if not host.is_display_service(pid, proc)]
    if others:
        names = ", ".join(f"{host.program_name(pid, proc)} ({pid})" for pid in others)
        return [Check(device, False, f"also open in {names}",
                      "Two programs on one motor board disturb each other: end one of them.")]
    whose = "" if os.geteuid() == 0 else " of this user"
    display = " but the service of the JetBot's display, which is normal" if users else ""
    return [Check(device, True, f"no other program{whose} has it open{display}")]


def check_cockpit_port(port: int = COCKPIT_PORT) -> List[Check]:
    """Check that no other program has the TCP port of the cockpit's page; [] if it is free, or a cockpit has it."""
    if is_free(port):
        return []
    names = {pid: host.program_name(pid) for pid in processes_on(port)}
    if "cockpit.py" in names.values():
        return []
    users = ", ".join(f"{name} ({pid})" for pid, name in names.items()) or "a program of another user"
    return [Check(f"port {port}", False, f"in use by {users}",
                  f"The cockpit needs another one: cockpit_port:={port + 1}")]


def check_supply(link: Union[I2CDevice, SerialLink]) -> List[Check]:
    """Check that the robot with this link to its board has the power to drive; [] if nothing measures that."""
    supply = find_supply(link)
    if not supply:
        return []
    try:
        reading = supply.read()
    except JetbotError as error:  # unplugged meanwhile
        return [Check("supply", False, error.reason, error.advice)]
    advice = ("Charge the battery." if reading.empty else
              "Use a supply of 5 V and 3 A, and a short cable." if reading.undervoltage else "")
    return [Check("supply", not advice, f"{reading}, by the {supply.sensor}", advice)]
