"""What this start of the controller drives: board, bus or port, the units of a command, the file of settings."""

from typing import Dict, List, Optional

from jetbot import fake
from jetbot.boards import BOARDS, MotorDriver
from jetbot.text import enumeration, printable

from ..parameters import PARAMETERS

GEOMETRY = ("wheel_separation", "max_speed")


def summary(parameters: Dict[str, object], driver: MotorDriver) -> Dict[str, str]:
    """Return a text for each of board, bus, address, units, settings and GEOMETRY.

    Those of GEOMETRY are numbers, "" for a board that does not use them. parameters: as ``resolve`` returns them.
    """
    config = parameters["config"]
    texts = {"board": parameters["board"], "bus": driver.link.name, "address": address_text(driver.link.address),
             "units": units(parameters, driver.closed_loop),
             "settings": f"settings from {config}" if config else "no file of settings",
             **{name: "" if driver.closed_loop else str(parameters[name]) for name in GEOMETRY}}
    return {name: printable(text) for name, text in texts.items()}


def address_text(address: Optional[int]) -> str:
    """Return how an I2C address is printed; "" for None, of a board on a serial port."""
    return f"0x{address:02x}" if address else ""


def units(parameters: Dict[str, object], closed_loop: bool) -> str:
    """Return what a command means. closed_loop: for a board that controls its wheel speeds itself."""
    if closed_loop:
        return "m/s and rad/s"
    if in_workshop_units(parameters):
        return "workshop units: left = x - z, right = x + z"
    separation, speed = (parameters[name] for name in GEOMETRY)
    return f"m/s and rad/s, with wheels {separation:g} m apart and {speed:g} m/s at full power"


def in_workshop_units(parameters: Dict[str, object]) -> bool:
    """Return whether wheel_separation and max_speed are the workshop's, and not the robot's."""
    return all(parameters[name] == PARAMETERS[name].default for name in GEOMETRY)


def start_line(texts: Dict[str, str]) -> str:
    """Return the ``summary`` as one line; it has the address where that is not the board's own."""
    own = texts["address"] == address_text(BOARDS[texts["board"]].address)
    return ("board {board} on {bus}; {units}; {settings}" if own else
            "board {board} at {address} on {bus}; {units}; {settings}").format(**texts)


def start_warnings(parameters: Dict[str, object], driver: MotorDriver) -> List[str]:
    """Return a sentence for each parameter that does not do what its user may expect. parameters: as ``summary``."""
    warnings = []
    ignored = [name for name in driver.ignores if parameters[name] != PARAMETERS[name].default]
    if ignored:
        warnings.append(f"the board {parameters['board']} ignores {enumeration(ignored)}")
    if parameters["publish_odom"] and not driver.closed_loop and in_workshop_units(parameters):
        warnings.append("odom is not in metres: add config:=si_units.yaml")
    return warnings


def status_suffix(driver: MotorDriver) -> str:
    """Return the end of each status on fake hardware, "" on a real robot."""
    if not fake.folder_of(driver.link.name):
        return ""
    return ", on a fake port" if driver.link.address is None else ", on a fake bus"
