"""What this computer measures of itself, as Linux shows it in sysfs and /proc. Everything is only read."""

import contextlib
import fcntl
import os
import re
import socket
import struct
from pathlib import Path
from typing import Callable, Dict, Iterable, Iterator, NamedTuple, Tuple

from .errors import JetbotError
from .health import believable
from .supply import on_computer

Readings = Dict[str, float]  # by names of health.READINGS

MAX_FILE = 4096  # bytes: a file of sysfs is one page

# Thermal zones of processors: of Jetson Linux 32 (CPU-therm) and 36 (cpu-thermal, tj-thermal), a Raspberry Pi
# (cpu-thermal), a PC (x86_pkg_temp). Others mislead: a Jetson Nano's PMIC-Die is always 100 °C.
PROCESSOR = re.compile("(cpu|gpu|soc|tj).*therm(al)?|x86_pkg_temp", re.IGNORECASE)

# Cooling devices that slow a processor down while their state is above 0 (Documentation/driver-api/thermal/sysfs-api):
# Linux's own, Jetson Linux 32's cpu-balanced and gpu-balanced, an Orin's cpu-throttle-alert and its like.
SLOWING = re.compile("(thermal-)?cpufreq.*|.*-balanced|.*-throttle-alert|Processor")

# https://www.raspberrypi.com/documentation/computers/os.html#get_throttled: bit 1, "Arm frequency capped", and bit 2,
# "currently throttled". Newer kernels log once that hwmon is to be used instead, which has the undervoltage alone.
THROTTLED = 0b110

# linux/wireless.h: the power management of an interface; struct iwreq with a struct iw_param: name of the interface;
# value, fixed, disabled, flags.
SIOCGIWPOWER = 0x8B2D
IWREQ = struct.Struct("16s i2BH 8x")


def power_save(interface: str) -> bool:
    """Return whether a Wi-Fi interface sleeps between packets; raise OSError where the driver does not say."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as any_socket:
        answer = fcntl.ioctl(any_socket, SIOCGIWPOWER, IWREQ.pack(os.fsencode(interface), 0, 0, 0, 0))
    return not IWREQ.unpack(answer)[3]


class Computer(NamedTuple):
    """Where a computer shows what it measures; home: a folder on the disk that matters, "" for the user's own."""

    sysfs: Path = Path("/sys")
    proc: Path = Path("/proc")
    home: str = ""
    power_save: Callable[[str], bool] = power_save

    def read(self) -> Readings:
        """Return what can be read now. It may take as long as Linux does, but raises nothing."""
        readings: Readings = {}
        for sensor in SENSORS:
            with contextlib.suppress(OSError, ValueError, RuntimeError):  # RuntimeError: a user without a home
                readings.update(sensor(self))
        return readings


def supply(computer: Computer) -> Readings:
    """Return the voltage of the computer's input, or whether it was too low."""
    readings: Readings = {}
    for each in on_computer(computer.sysfs):
        try:
            reading = each.read()
        except JetbotError:
            continue
        if reading.undervoltage is None:
            readings["input_volts"] = reading.voltage
        else:
            readings["undervoltage"] = max(reading.undervoltage, readings.get("undervoltage", 0))
    return readings


def temperature(computer: Computer) -> Readings:
    """Return the temperature of the hottest processor."""
    zones = _with_type(computer.sysfs.glob("class/thermal/thermal_zone*"), PROCESSOR)
    degrees = [value / 1000 for value in _numbers(zone / "temp" for zone in zones)]
    believed = [value for value in degrees if believable("celsius", value)]
    return {"celsius": max(believed)} if believed else {}


def throttling(computer: Computer) -> Readings:
    """Return whether the processors are slowed down. cpufreq's scaling_cur_freq does not tell: idle ones are slow."""
    devices = _with_type(computer.sysfs.glob("class/thermal/cooling_device*"), SLOWING)
    slowed = [value > 0 for value in _numbers(device / "cur_state" for device in devices)]
    for file in computer.sysfs.glob("devices/platform/soc*/soc*:firmware/get_throttled"):
        with contextlib.suppress(OSError, ValueError):
            slowed.append(bool(int(_text(file), 16) & THROTTLED))
    return {"throttled": any(slowed)} if slowed else {}


def disk(computer: Computer) -> Readings:
    """Return how much this user may still write."""
    status = os.statvfs(computer.home or Path.home())
    return {"megabytes": status.f_bavail * status.f_frsize / 1e6}


def wifi(computer: Computer) -> Readings:
    """Return the signal of the connected Wi-Fi, and whether it saves power.

    A line of /proc/net/wireless has an interface, its status, and the link's quality, level and noise (wireless.7).
    """
    lines = [line.split() for line in _text(computer.proc / "net/wireless").splitlines()[2:]]
    levels = {words[0].rstrip(":"): float(words[3]) for words in lines if len(words) > 3}
    connected = {interface: level for interface, level in levels.items() if -200 < level < 0}  # -256: not connected
    if not connected:
        return {}
    interface = max(connected, key=lambda name: connected[name])
    readings: Readings = {"dbm": connected[interface]}
    with contextlib.suppress(OSError):
        readings["power_save"] = computer.power_save(interface)
    return readings


SENSORS: Tuple[Callable[[Computer], Readings], ...] = (supply, temperature, throttling, disk, wifi)


def _with_type(folders: Iterable[Path], types: "re.Pattern[str]") -> Iterator[Path]:
    """Yield the folders whose file "type" has one of these types."""
    for folder in folders:
        with contextlib.suppress(OSError):
            if types.fullmatch(_text(folder / "type")):
                yield folder


def _numbers(files: Iterable[Path]) -> Iterator[float]:
    """Yield the number in each file that has one now: a processor that is switched off has no temperature."""
    for file in files:
        with contextlib.suppress(OSError, ValueError):
            yield float(_text(file))


def _text(file: Path) -> str:
    with file.open(errors="replace") as stream:
        return stream.read(MAX_FILE).strip()
