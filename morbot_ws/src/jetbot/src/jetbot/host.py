"""This computer: its model, its I2C buses, the one that a JetBot's motors are on, its addresses, and ROS's home."""

import contextlib
import ipaddress
import os
import re
import shlex
import socket
import struct
from pathlib import Path
from typing import Any, List, Optional, Set, Tuple, Union

from .text import printable

# Part of the model's name, in lower case and without hyphens: the bus on pins 3 and 5 of the 40-pin header, by NVIDIA's
# and Raspberry Pi's pinouts, and Adafruit Blinka's for a Thor, whose developer kit has no such header. Jetson Linux 32
# calls a TX2 "quill" and an AGX Xavier "jetson-xavier" or "Jetson-AGX"; Jetson Linux 35 an Orin NX "NVIDIA Orin NX".
ROBOT_BUS = {"orin": 7, "thor": 7, "xavier": 8, "jetson agx": 8, "jetson nano": 1, "jetson tx2": 1, "quill": 1,
             "raspberry pi": 1}

# The display of the JetBot library's images: its systemd unit, and how that starts it (create_stats_service.py).
DISPLAY_SERVICE = (b"jetbot_stats.service", b"jetbot.apps.stats", b"jetbot/apps/stats.py")


def peer_of(connection: socket.socket) -> Tuple[int, int]:
    """Return the process and the user at the other end of a unix socket; the process is 0 in another container."""
    return struct.unpack("3i", connection.getsockopt(socket.SOL_SOCKET, socket.SO_PEERCRED, struct.calcsize("3i")))[:2]


def program_name(pid: int, proc: Path = Path("/proc")) -> str:
    """Return the name of a process's program, a script's own rather than Python's; "" where /proc does not show it."""
    try:
        words = (proc / str(pid) / "cmdline").read_text(errors="replace").split("\0")[:-1]
    except OSError:
        return ""
    names = [os.path.basename(word) for word in words]
    if len(names) > 1 and names[0].startswith("python") and not names[1].startswith("-"):
        return printable(names[1])
    return printable(names[0]) if names else ""


def processes_with(files: Set[str], proc: Path = Path("/proc")) -> List[int]:
    """Return the ids of the processes that have one of these open, as far as this user may see.

    files: as the links in /proc/PID/fd show them, such as /dev/i2c-1 and socket:[12345].
    """
    return [int(process.name) for process in proc.glob("[0-9]*") if files & open_files(process)]


def open_files(process: Path) -> Set[str]:
    """Return what a process has open; nothing of another user's. process: its folder in /proc."""
    links = set()
    with contextlib.suppress(OSError):  # another user's, or ended meanwhile
        for link in (process / "fd").iterdir():
            with contextlib.suppress(OSError):  # closed meanwhile, as the folder itself is in this process
                links.add(os.readlink(link))
    return links


def is_display_service(pid: int, proc: Path = Path("/proc")) -> bool:
    """Return whether a process is the service that writes to the display of a JetBot, by its unit or command line."""
    text = b""
    for name in ("cgroup", "cmdline"):
        with contextlib.suppress(OSError):
            text += (proc / str(pid) / name).read_bytes()
    return any(part in text for part in DISPLAY_SERVICE)


def by_morbot(arguments: str, otherwise: str) -> str:
    """Return the command ./morbot with these arguments where ./morbot has started this program, else the other one."""
    morbot = os.environ.get("MORBOT")  # the name by which it was started
    return f"{shlex.quote(morbot)} {arguments}" if morbot else otherwise


def in_shell(command: str) -> str:
    """Return a command that needs ROS and this workspace, as it works where this program was started."""
    return by_morbot(f"shell {command}", command)


def doctor_command() -> str:
    """Return the command that starts doctor.py."""
    return by_morbot("doctor", "rosrun jetbot_tools doctor.py")


def ros_home() -> Path:
    """Return the folder where ROS keeps a user's files: ROS_HOME, else ~/.ros."""
    return Path(os.environ.get("ROS_HOME") or Path.home() / ".ros")


def model(file: Path = Path("/proc/device-tree/model")) -> str:
    """Return the computer's model, as its maker names it; "" for a computer without a device tree, such as a PC."""
    return file.read_text().rstrip("\0") if file.exists() else ""


def robot_bus(name: str) -> Optional[int]:
    """Return the number of the bus that the motors are on, for a computer of this model; None for an unknown one."""
    plain = name.lower().replace("-", " ")
    return next((bus for part, bus in ROBOT_BUS.items() if part in plain), None)


def mishandles_clock_stretching(name: str) -> bool:
    """Return whether a computer of this model may fail to wait for a chip that holds the clock: a Raspberry Pi up to 4.

    https://github.com/raspberrypi/linux/issues/4884; the bus of a Raspberry Pi 5 is on another chip, its RP1.
    """
    return "Raspberry Pi" in name and not re.search("Raspberry Pi (Compute Module )?[5-9]", name)


def kernel_driver(device: str, devices: Path = Path("/sys/bus/i2c/devices")) -> str:
    """Return the kernel driver that holds a chip, "" for none. device: as Linux names it, 1-0040 for 0x40 on bus 1."""
    try:
        return os.path.basename(os.readlink(devices / device / "driver"))
    except OSError:
        return ""


def buses(dev: Path = Path("/dev")) -> List[int]:
    """Return the numbers of this computer's I2C buses."""
    return sorted(int(path.name[len("i2c-"):]) for path in dev.glob("i2c-*"))


def permission_advice(device: Union[str, Path], usual_group: str) -> str:
    """Return what to do so that this user may open a device; usual_group: the group that usually owns such devices."""
    try:
        number = os.stat(device).st_gid
        import grp  # here: Windows has none
        group = grp.getgrgid(number).gr_name
    except OSError:  # unplugged meanwhile
        group = usual_group
    except KeyError:
        return f"Its group has no name here, as in a container; start that with: --group-add {number}"
    join = "Join its group with:"
    if group == "root":
        group = usual_group
        join = f"Give it to a group: sudo chgrp {group} {device} && sudo chmod g+rw {device}   and join that:"
    return f"{join} sudo usermod -aG {group} $USER   and log in again."


def bus_advice() -> str:
    """Return which buses this computer has, and which one to use."""
    existing = ", ".join(f"/dev/i2c-{bus}" for bus in buses()) or "no /dev/i2c-* at all"
    usual = robot_bus(model())
    hint = f" On a {model()} the motors are on i2c_bus {usual}." if usual is not None else ""
    return f"This computer has {existing}.{hint}"


def is_loopback(host: Any) -> bool:
    """Return whether a host's name or address always means the computer that uses it."""
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return host in ("localhost", "localhost.localdomain", "ip6-localhost", "ip6-loopback")


def is_this_host(host: Any) -> bool:
    """Return whether a name or an address is this computer's. No other name is looked up: its owner could change it."""
    if is_loopback(host) or str(host).lower() == socket.gethostname().lower():
        return True
    try:
        address = ipaddress.ip_address(host)
        family = socket.AF_INET if address.version == 4 else socket.AF_INET6
        with socket.socket(family, socket.SOCK_STREAM) as probe:
            probe.bind((str(address), 0))  # works for this computer's addresses only
    except (OSError, ValueError):
        return False
    return True
