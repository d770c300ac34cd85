"""All checks in their order, and the verdict: whether a robot could drive, and how."""

import os
import sys
from pathlib import Path
from typing import Iterator, List, Optional, Union

from jetbot import fake, host
from jetbot.boards import BOARDS, DEFAULT_PORT
from jetbot.errors import JetbotError
from jetbot.i2c import I2CDevice, bus_name
from jetbot.serial_link import SerialLink
from jetbot_control_node.parameters import checked, default_file, load

from ..options import launch_command
from . import jetbot_module
from .camera_check import check_cameras
from .computer import Check, check_battery, check_cockpit_port, check_health, check_host, check_module, check_users
from .motor_board import JUMPER_ADDRESSES, check_board, check_chips, check_serial

MODULES = ["rospy", "diagnostic_updater", "nav_msgs", "sensor_msgs", "tf2_ros", "yaml", "smbus2", "serial", "tornado"]
NEEDED_BY_SOME = ["smbus2", "serial", "tornado"]  # by boards on an I2C bus, on a serial port; by the cockpit


def run_checks(i2c_bus: Union[int, str, None] = None, port: Optional[str] = None,
               i2c_address: Optional[int] = None, board: str = "") -> Iterator[Check]:
    """Yield every Check, the verdict last.

    i2c_bus: N for /dev/i2c-N, fake, or fake:FOLDER; port: a serial port, or the same. A board is looked for there;
    without both, on every bus of this computer and on the default port. i2c_address: look there alone on each bus.
    board: a name in BOARDS; look for this one alone.
    """
    checks = []
    for check in all_checks(i2c_bus, port, i2c_address, board):
        checks.append(check)
        yield check
    yield verdict(checks, board)


def all_checks(i2c_bus: Union[int, str, None], port: Optional[str], i2c_address: Optional[int],
               board: str) -> Iterator[Check]:
    """Yield all checks but the verdict: of the computer, and of what its robot may be connected to."""
    yield from map(check_module, MODULES)
    yield from check_jetbot()
    yield check_host()
    yield from check_cockpit_port()
    file = default_file()
    if not any(fake.folder_of(fake.expand(str(place))) for place in (i2c_bus, port)):
        yield from check_health()
        if os.path.lexists(file):
            yield check_file(file)
    on_bus = bool(BOARDS[board].address) if board else i2c_bus is not None or port is None
    found = False
    for check in check_buses(i2c_bus, i2c_address, board) if on_bus else ():
        found = found or bool(check.command)
        yield check
    if not (found or board and on_bus):
        yield from check_port(port or DEFAULT_PORT)
    yield from check_cameras()


def check_jetbot() -> Iterator[Check]:
    """Yield a check that names each module ``jetbot``, if not all are MorBot's."""
    finding = jetbot_module.finding(sys.path)
    if finding:
        yield Check("jetbot", True, finding, "Programs that are started elsewhere import that one: type ./morbot shell")


def check_buses(i2c_bus: Union[int, str, None], i2c_address: Optional[int], board: str) -> Iterator[Check]:
    """Yield the checks of the bus, or of every bus of this computer until one has a board; of its battery, too."""
    usual = host.robot_bus(host.model()) if i2c_bus is None else i2c_bus
    buses = sorted(host.buses(), key=lambda bus: bus != usual) if i2c_bus is None else [i2c_bus]
    if not buses:
        yield Check("I2C buses", False, "there is no /dev/i2c-*",
                    "On a Raspberry Pi switch I2C on with: sudo raspi-config   A PC has none.")
    for bus in buses:
        checks = check_bus(bus, i2c_address, board, other_addresses=bus == usual)
        yield from checks
        if any(check.command for check in checks):
            yield from check_battery(I2CDevice(bus, BOARDS["jetbot"].address))
            return


def check_port(port: str) -> Iterator[Check]:
    """Yield the checks of a serial port."""
    yield from check_users(port)
    yield check_serial(port)
    yield from check_battery(SerialLink(port))


def check_file(file: Path) -> Check:
    """Check that the file of parameters can be used and that its board answers."""
    try:
        parameters = checked(load(file))
        board = parameters["board"]
        answer = check_board(board, parameters["i2c_bus"], parameters["port"], parameters["i2c_address"])
    except JetbotError as error:
        return Check(str(file), False, error.reason, "Fix it, or remove it.")
    if answer.ok:
        return Check(str(file), True, f"names the board {board}, and {answer.name} answers", answer.advice,
                     launch_command())
    return Check(str(file), False, f"names the board {board}, but {answer.finding}",
                 "Connect that board; or remove the file, and calibrate again.")


def check_bus(bus: Union[int, str], i2c_address: Optional[int] = None, board: str = "",
              other_addresses: bool = False) -> List[Check]:
    """Check that a board is on a bus, and that no other program uses it.

    board: the only one to look for. i2c_address: the only one to check; without it, those of the boards, and if none of
    them is there, and ``other_addresses`` is true, those that their jumpers select: on another bus, chips of the
    computer itself may be.
    """
    try:
        name = bus_name(bus)
    except JetbotError as error:
        return [Check(f"bus {bus}", False, error.reason, error.advice)]
    rows = [BOARDS[board]] if board else BOARDS.values()
    addresses = list(dict.fromkeys(row.address for row in rows if row.address))
    if i2c_address is not None:
        addresses = [i2c_address]
    chips = check_chips(bus, addresses, board)
    boards = [chip for chip in chips if chip.ok]
    if other_addresses and i2c_address is None and not boards:
        jumpers = [address for address in JUMPER_ADDRESSES if not board or address in BOARDS[board].jumpers]
        boards = [chip for chip in check_chips(bus, jumpers, board) if chip.ok]
    return check_users(name) + (boards or chips)


def verdict(checks: List[Check], board: str = "") -> Check:
    """Return whether a robot could drive, and how; not ok if only a person knows. board: the one that was named."""
    needed = {*MODULES, str(default_file())}.difference(NEEDED_BY_SOME)
    faults = [check.name for check in checks if not check.ok and check.name in needed]
    if faults:
        return Check("robot", False, f"cannot drive as long as {faults[0]} is not ok")
    boards = [check for check in checks if check.command]
    if not boards:
        return Check("robot", False, "no motor board found",
                     "Fix the items marked NOT. To try everything without one: "
                     + host.in_shell("roslaunch simulation simulation.launch"))
    best = min(boards, key=lambda check: bool(check.condition))
    condition = "" if board else best.condition
    return Check("robot", not condition, f"could drive{condition and f' if {condition}'}",
                 f"Start it with: {best.command}", best.command, condition)
