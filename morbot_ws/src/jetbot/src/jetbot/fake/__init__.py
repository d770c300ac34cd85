"""Simulated hardware, chosen by name: ``fake`` and ``fake:FOLDER`` in the place of a bus or a serial port.

The folder is the bus or the port, a file in it a chip or a board. Every process that opens the folder uses the same.
"""

import shlex
from pathlib import Path
from typing import Optional, Union

from ..host import in_shell, ros_home

Folder = Union[str, Path]


def default_folder(namespace: str = "/") -> Path:
    """Return the folder that plain ``fake`` means: fake_i2c plus the node's namespace in ROS's home (~/.ros)."""
    return ros_home() / "fake_i2c" / namespace.strip("/")


def expand(name: str, namespace: str = "/") -> str:
    """Return ``fake:FOLDER`` with an absolute path for a fake bus or port; any other name unchanged."""
    folder = default_folder(namespace) if name == "fake" else folder_of(name)
    return f"fake:{Path(folder).absolute()}" if folder else name


def folder_of(name: str) -> Optional[str]:
    """Return FOLDER if the name is ``fake:FOLDER``, else None."""
    return name[len("fake:"):] or None if name.startswith("fake:") else None


def power_on_command(folder: Folder, address: Optional[int] = None, chip: str = "") -> str:
    """Return the command that plugs all simulated boards in there, and a chip at this address, by default a PCA9685."""
    option = f" --i2c-address 0x{address:02x}" if address else ""
    option += f" --chip {chip}" if chip not in ("", "PCA9685") else ""
    return in_shell(f"python3 -m jetbot.fake {shlex.quote(str(folder))}{option}")


def chip_file(folder: Folder, address: Optional[int]) -> Path:
    """Return the file that holds the chip at this I2C address; None: the JetBot Pro on the serial port."""
    return Path(folder, "jetbot_pro" if address is None else f"0x{address:02x}")
