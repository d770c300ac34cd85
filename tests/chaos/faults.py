"""The faults: a row each. A fault begins, and ends by itself or by what ``begin`` returns."""

import contextlib
import os
import resource
import signal
import subprocess
import sys
from pathlib import Path
from typing import Callable, NamedTuple, Optional

import world

HOG = "while True: pass"


class Fault(NamedTuple):
    """What happens, to which kinds of process (all if empty). begin: does it; returns what ends it, or None."""

    begin: Callable
    targets: str = ""


def kill(_, process):
    process.signal(signal.SIGKILL)


def terminate(_, process):
    process.signal(signal.SIGTERM)


def freeze(_, process):
    process.signal(signal.SIGSTOP)
    return lambda: process.signal(signal.SIGCONT)


def limit(kind: int, usage: Callable[[int], int]) -> Callable:
    """Return a fault that leaves a process what it uses now, and takes the limit away at its end."""
    def begin(_, process):
        before = resource.prlimit(process.pid, kind)
        with contextlib.suppress(OSError, ValueError):
            resource.prlimit(process.pid, kind, (usage(process.pid), before[1]))
        return lambda: resource.prlimit(process.pid, kind, before) if process.alive() else None
    return begin


def memory(pid: int) -> int:
    """Return the size of a process in bytes: no thread can be started any more."""
    return int(Path(f"/proc/{pid}/statm").read_text().split()[0]) * resource.getpagesize()


def descriptors(pid: int) -> int:
    """Return how many file descriptors a process has."""
    return len(os.listdir(f"/proc/{pid}/fd"))


def hogs(scene, _):
    programs = [subprocess.Popen([sys.executable, "-c", HOG]) for _ in range(4)]
    return lambda: [(program.kill(), program.wait()) for program in programs]


def short_publishers(scene, _):
    """Let programs come and go, so that Linux gives their ports out again."""
    for _ in range(3):
        with contextlib.suppress(subprocess.TimeoutExpired):
            scene.run("rostopic", "pub", "-1", "/elsewhere", "std_msgs/Bool", "true", timeout=5)


def second_start(scene, process):
    """Start the same node again beside the first one: it must refuse."""
    second = scene.again(process)
    return second.end


def unplug(scene, process):
    chip = scene.chip(process)
    with contextlib.suppress(FileNotFoundError):
        chip.rename(f"{chip}.out")
    return lambda: Path(f"{chip}.out").rename(chip) if Path(f"{chip}.out").exists() else None


def slow_bus(scene, process):
    """Let the next transfers fail: the driver opens the bus again, and finds it at 10 kHz."""
    folder = scene.chip(process).parent
    (folder / "clock").write_text("10000")
    (folder / "0x60.fail").write_text("2")
    return lambda: (folder / "clock").unlink()


FAULTS = {
    "kill": Fault(kill),
    "terminate": Fault(terminate),
    "freeze": Fault(freeze),
    "no thread": Fault(limit(resource.RLIMIT_AS, memory), "controller cockpit master"),
    "no memory": Fault(limit(resource.RLIMIT_DATA, lambda pid: 1 << 20), "controller cockpit"),
    "no descriptor": Fault(limit(resource.RLIMIT_NOFILE, descriptors), "controller cockpit master"),
    "full disk": Fault(limit(resource.RLIMIT_FSIZE, lambda pid: 0), "controller launch cockpit master"),
    "ports again": Fault(short_publishers),
    "second start": Fault(second_start, "controller"),
    "unplugged": Fault(unplug, "controller"),
    "slow bus": Fault(slow_bus, "controller"),
    "busy computer": Fault(hogs),
}


def begin(name: str, scene: "world.Scene", process: Optional["world.Process"]) -> Callable[[], None]:
    """Begin the fault of this name; return what ends it."""
    return FAULTS[name].begin(scene, process) or (lambda: None)
