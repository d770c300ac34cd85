"""Finds out what keeps a JetBot from driving. Reads only: it never moves a wheel."""

import contextlib
import importlib.util
import os
import time
from pathlib import Path
from typing import NamedTuple

from jetbot import host
from jetbot.boards import BOARDS, PORT, scmd
from jetbot.boards.jetbot_pro import FrameReader, reports
from jetbot.errors import InvalidValue, JetbotError
from jetbot.i2c import I2CDevice, bus_name
from jetbot.serial_link import SerialLink
from jetbot_ros.parameters import checked, default_file, load

PACKAGES = {"rospy": "rospy", "diagnostic_updater": "diagnostic-updater", "nav_msgs": "nav-msgs",
            "sensor_msgs": "sensor-msgs", "tf2_ros": "tf2-ros", "yaml": "yaml", "smbus2": "smbus2", "serial": "serial"}
NOT_FOR_EVERY_ROBOT = ("smbus2", "serial")  # but for those on an I2C bus, or on a serial port
ADDRESSES = sorted({row.address for row in BOARDS.values() if row.address})  # on the I2C bus
LISTENING = 1.0  # seconds for the JetBot Pro to report; it does so many times a second
LAUNCH = "roslaunch jetbot_control_node jetbot_controller.launch"


class Check(NamedTuple):
    """One thing looked at: what was found, and what to do where it is not as it should be."""

    name: str
    ok: bool
    finding: str
    advice: str = ""
    command: str = ""  # starts a robot that this check has found

    def __str__(self):
        return f"{'ok' if self.ok else 'NOT':<4}{self.name}: {self.finding}. {self.advice}".rstrip()


def examine(bus=None, port=PORT):
    """Yield all Checks, the last one telling whether a robot could drive.

    bus: N for /dev/i2c-N or a fake bus, None for every /dev/i2c-* there is; port: the serial port of a JetBot Pro.
    """
    checks = []
    for check in look(bus, port):
        checks.append(check)
        yield check
    yield conclude(checks)


def look(bus, port):
    """Yield a Check of everything; of the buses until one has a board."""
    yield from map(check_package, PACKAGES)
    yield check_computer()
    yield from check_file(default_file())
    found = False
    for each in all_buses() if bus is None else [bus]:
        for check in check_bus(each):
            found = found or check.ok and bool(check.command)
            yield check
        if found:
            break
    if bus is None and not host.buses():
        yield Check("I2C buses", False, "there is no /dev/i2c-*",
                    "On a Raspberry Pi switch I2C on with: sudo raspi-config   A PC has none.")
    if not found or os.path.exists(port):
        yield from check_device(port)
        yield check_serial(port)


def all_buses():
    """The numbers of all buses, first the one that this computer's motors should be on."""
    usual = host.robot_bus(host.model())
    return sorted((int(path.name[len("i2c-"):]) for path in host.buses()), key=lambda bus: (bus != usual, bus))


def check_package(module):
    """Whether a Python module that the robot needs is installed."""
    if importlib.util.find_spec(module):
        return Check(module, True, "installed")
    return Check(module, False, "not installed", how_to_install(module))


def how_to_install(module, noetic=Path("/opt/ros/noetic")):
    """The command that brings a Python module, on Ubuntu 20.04 with Noetic or on a system that has ROS itself."""
    if not noetic.exists() or module in ("serial", "yaml"):
        return f"Install it with: sudo apt install python3-{PACKAGES[module]}"
    if module == "smbus2":
        return "Install it with: pip3 install smbus2"
    return f"Type: source {noetic}/setup.bash   Or install it with: sudo apt install ros-noetic-{PACKAGES[module]}"


def check_computer():
    """Which computer this is, and which bus its robot is on."""
    model = host.model()
    bus = host.robot_bus(model)
    if bus is None:
        return Check("computer", True, model or "not one of those that a JetBot carries")
    return Check("computer", True, f"{model}, whose motors are on /dev/i2c-{bus}")


def check_bus(bus):
    """Whether this user may open a bus, who else has, and which boards are on it."""
    try:
        device = check_device(bus_name(bus))
    except InvalidValue as error:
        yield Check(f"bus {bus}", False, error.reason, error.advice)
        return
    yield from device
    if all(check.ok for check in device[:1]):
        boards = [check_address(bus, address) for address in ADDRESSES]
        yield from [check for check in boards if check.ok] or boards[-1:]


def check_device(name):
    """Whether this user may open a device, and who else has; nothing where there is no such device."""
    path = Path(name)
    if not os.path.exists(path):
        return []
    if not os.access(path, os.R_OK | os.W_OK):
        group = "i2c" if path.name.startswith("i2c-") else "dialout"
        return [Check(name, False, "this user may not open it", host.permission_advice(path, group))]
    return [Check(name, True, "this user may open it"), check_users(path)]


def check_users(path, proc=Path("/proc")):
    """Whether another program has the device open."""
    users = [f"{name_of(process)} ({process.name})" for process in proc.glob("[0-9]*")
             if int(process.name) != os.getpid() and has_open(process, path.resolve())]
    if not users:
        whose = "no other program" if os.geteuid() == 0 else "no other program of this user"
        return Check(str(path), True, f"{whose} has it open")
    return Check(str(path), False, f"also open in {', '.join(users)}",
                 "Two programs on one motor board disturb each other: end one of them.")


def name_of(process):
    """The name of a process, a folder in /proc."""
    with contextlib.suppress(OSError):
        return (process / "comm").read_text().strip()
    return "a program that has just ended"


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
        chip = I2CDevice(bus, address)
        answer = chip.read(scmd.ID)
        chip.close()
    except JetbotError as error:
        return Check(name, False, error.reason, error.advice)
    if address == BOARDS["sparkfun"].address and answer != scmd.ID_WORD:
        return Check(name, False, "what answers is no SparkFun motor driver", "It is of no use for driving.")
    boards = boards_at(address)
    return Check(name, True, f"answers, and can be a board {' or '.join(boards)}",
                 command=f"{LAUNCH} board:={boards[0]} i2c_bus:={bus}")


def boards_at(address):
    """The names of the boards at an I2C address; those of one address cannot be told apart by a read."""
    return [name for name, row in BOARDS.items() if row.address == address]


def check_serial(port):
    """Whether a JetBot Pro reports on the serial port."""
    try:
        link = SerialLink(port)
        reporting = listen(link)
        link.close()
    except JetbotError as error:
        return Check(port, False, error.reason, error.advice)
    if reporting:
        return Check(port, True, "a JetBot Pro reports", command=f"{LAUNCH} board:=jetbot_pro port:={port}")
    return Check(port, False, "opens, but no JetBot Pro reports", "Is it this port, and is the robot switched on?")


def listen(link):
    """Whether a report arrives within ``LISTENING`` seconds."""
    reader, deadline = FrameReader(), time.monotonic() + LISTENING
    while time.monotonic() < deadline:
        if any(reports(reader.feed(link.read()))):
            return True
    return False


def check_file(file):
    """Whether the file of parameters, where there is one, can be read and its board answers."""
    if not os.path.exists(file):
        return []
    try:
        parameters = checked(load(file))
    except JetbotError as error:
        return [Check(str(file), False, error.reason, "Mend it, or remove it.")]
    board, bus, port = parameters["board"], parameters["i2c_bus"], parameters["port"]
    address = BOARDS[board].address
    link = check_address(bus, address) if address else check_serial(port)
    if link.ok:
        return [Check(str(file), True, f"names the board {board}, and {link.name} answers", command=LAUNCH)]
    return [Check(str(file), False, f"names the board {board}, but {link.finding}",
                  "Connect that board; or remove the file, and calibrate anew.")]


def conclude(checks):
    """Whether a robot could drive, and how."""
    needed = {*PACKAGES, str(default_file())}.difference(NOT_FOR_EVERY_ROBOT)
    faults = [check.name for check in checks if not check.ok and check.name in needed]
    if faults:
        return Check("robot", False, f"cannot drive as long as {faults[0]} is not ok")
    commands = [check.command for check in checks if check.command]
    if not commands:
        return Check("robot", False, "no motor board found",
                     "Mend what is NOT ok above. To try everything without one: roslaunch simulation simulation.launch")
    return Check("robot", True, "could drive", f"Start it with: {commands[0]}", commands[0])
