"""Checks of the computer: its Python modules, other programs in the way, and what it and its robot measure."""

import importlib.util
import os
from pathlib import Path
from typing import List, NamedTuple, Optional, Union

from jetbot import host
from jetbot.errors import JetbotError
from jetbot.health import OK, Health, judge
from jetbot.health_sensors import Computer
from jetbot.i2c import I2CDevice
from jetbot.serial_link import SerialLink
from jetbot.supply import on_bus
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


def check_health(computer: Optional[Computer] = None) -> List[Check]:
    """Check what the computer measures: its supply, temperature, disk and Wi-Fi. computer: None for this one."""
    return [as_check(row) for row in judge((computer or Computer()).read())]


def as_check(row: Health) -> Check:
    """Return what there is to say of the robot's health as a check."""
    sentence, _, advice = str(row).partition(". ")
    name, _, finding = sentence.rstrip(".").rpartition(": ")
    return Check(name or row.code, row.level == OK, finding, advice)


def check_battery(link: Union[I2CDevice, SerialLink]) -> List[Check]:
    """Check that the battery of the robot with this link to its board is charged; [] if no chip measures that."""
    for supply in on_bus(link):
        try:
            reading = supply.read()
        except JetbotError:  # another chip
            continue
        rows = [as_check(row) for row in judge(reading.battery)] or [Check("Battery", True, str(reading))]
        return [row._replace(finding=f"{row.finding}, by the {supply.sensor}") for row in rows]
    return []
