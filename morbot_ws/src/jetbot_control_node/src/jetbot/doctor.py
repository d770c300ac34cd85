"""Finds out what keeps a JetBot from driving. Reads only: it never moves a wheel."""

import grp
import importlib.util
import os
import time
from pathlib import Path
from typing import NamedTuple

from . import computer
from .boards import BOARDS
from .errors import JetbotError
from .i2c import I2CDevice
from .jetbot_pro import TELEMETRY, FrameReader
from .serial_link import SerialLink

PACKAGES = {"rospy": "python3-rospy", "smbus2": "python3-smbus2", "serial": "python3-serial"}  # module: Debian package
ADDRESSES = sorted({row.address for row in BOARDS.values() if row.address})  # on the I2C bus
LISTENING = 1.0  # seconds for the JetBot Pro to report; it does so many times a second


class Check(NamedTuple):
    """One thing looked at: what was found, and where that is not as it should be, what to do."""

    name: str
    ok: bool
    finding: str
    advice: str = ""

    def __str__(self):
        return f"{'ok' if self.ok else 'NOT':<4}{self.name}: {self.finding}. {self.advice}".rstrip()


def examine(buses, port):
    """Yield all Checks, the last one telling whether a robot could drive.

    buses: what to probe, each N for /dev/i2c-N or a fake bus; port: the serial port of a JetBot Pro.
    """
    missing = []
    for module, package in PACKAGES.items():
        check = check_package(module, package)
        missing += [] if check.ok else [module]
        yield check
    yield check_computer()
    yield check_buses(computer.buses())
    ways = []
    for bus in buses:
        path = Path(f"/dev/i2c-{bus}")
        if path.exists():
            yield check_permission(path)
            yield check_users(path)
        for address in ADDRESSES:
            check = check_address(bus, address)
            ways += [f"board:={boards_at(address)[0]} i2c_bus:={bus}"] if check.ok else []
            yield check
    check = check_serial(port)
    ways += [f"board:=jetbot_pro port:={port}"] if check.ok else []
    yield check
    yield conclude(missing, ways)


def check_package(module, package):
    """Whether a Python module that the robot needs is installed."""
    if importlib.util.find_spec(module):
        return Check(module, True, "installed")
    return Check(module, False, "not installed", f"Install it with: sudo apt install {package}")


def check_computer():
    """Which computer this is, and which bus its robot is on."""
    model = computer.model()
    bus = computer.robot_bus(model)
    if bus is None:
        return Check("computer", True, model or "not one of those that a JetBot carries")
    return Check("computer", True, f"{model}, whose motors are on /dev/i2c-{bus}")


def check_buses(paths):
    """Whether there is any I2C bus."""
    if paths:
        return Check("I2C buses", True, ", ".join(map(str, paths)))
    return Check("I2C buses", False, "there is no /dev/i2c-*",
                 "On a Raspberry Pi switch I2C on with: sudo raspi-config   On a PC there is none: use i2c_bus:=fake")


def check_permission(path):
    """Whether this user may open the bus."""
    if os.access(path, os.R_OK | os.W_OK):
        return Check(str(path), True, "this user may open it")
    group = grp.getgrgid(path.stat().st_gid).gr_name
    if group == "root":
        return Check(str(path), False, "only root may open it",
                     "Give it to a group with: sudo apt install i2c-tools   then start the computer again.")
    return Check(str(path), False, "this user may not open it",
                 f"Join its group with: sudo usermod -aG {group} $USER   and log in again.")


def check_users(path, proc=Path("/proc")):
    """Whether another program has the bus open."""
    users = [f"{(process / 'comm').read_text().strip()} ({process.name})" for process in proc.glob("[0-9]*")
             if int(process.name) != os.getpid() and has_open(process, path)]
    if not users:
        return Check(str(path), True, "no other program has it open")
    return Check(str(path), False, f"also open in {', '.join(users)}",
                 "Two programs on one motor board disturb each other: end one of them.")


def has_open(process, path):
    """Whether the process, a folder in /proc, has the file open, as far as this user may know."""
    try:
        return any(os.readlink(file) == str(path) for file in (process / "fd").iterdir())
    except OSError:
        return False


def check_address(bus, address):
    """Whether a motor board answers a read at this address."""
    name = f"0x{address:02x} on bus {bus}"
    try:
        with_chip = I2CDevice(bus, address)
        with_chip.read(0x00)
        with_chip.close()
    except JetbotError as error:
        return Check(name, False, error.reason, error.advice)
    return Check(name, True, f"answers, and can be a board {' or '.join(boards_at(address))}")


def boards_at(address):
    """The names of the boards at an I2C address; those of one address cannot be told apart by a read."""
    return [name for name, row in BOARDS.items() if row.address == address]


def check_serial(port):
    """Whether a JetBot Pro reports on the serial port."""
    try:
        link = SerialLink(port)
        reports = listen(link)
        link.close()
    except JetbotError as error:
        return Check(port, False, error.reason, error.advice)
    if reports:
        return Check(port, True, "a JetBot Pro reports")
    return Check(port, False, "opens, but no JetBot Pro reports", "Is it this port, and is the robot switched on?")


def listen(link):
    """Whether a report arrives within ``LISTENING`` seconds."""
    reader, deadline = FrameReader(), time.monotonic() + LISTENING
    while time.monotonic() < deadline:
        if any(kind == TELEMETRY for kind, _ in reader.feed(link.read())):
            return True
    return False


def conclude(missing, ways):
    """Whether a robot could drive, and how."""
    if missing:
        return Check("robot", False, f"cannot drive without {', '.join(missing)}")
    if not ways:
        return Check("robot", False, "no motor board found", "To try everything without one: i2c_bus:=fake")
    return Check("robot", True, f"drive it with: roslaunch jetbot_control_node jetbot_controller.launch {ways[0]}")
