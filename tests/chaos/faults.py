"""The faults: a row each. A fault begins, and ends by itself or by what its function returns."""

import contextlib
import ctypes
import os
import random
import resource
import signal
import socket
import struct
import subprocess
import sys
import time
from pathlib import Path
from typing import Callable, List, NamedTuple, Optional

import bus
import bystanders
import link
from process import Process
from world import ALL, Scene

OURS = ("controller", "cockpit", "guard")  # which keep their promises without memory, threads or descriptors
LIMITED = (*OURS, "master")
REFUSES = 8.0  # s until a program that must not run has ended
SYS_PIDFD_OPEN, SYS_PIDFD_GETFD = 434, 438
SO_ATTACH_FILTER, SO_DETACH_FILTER = 26, 27
DROP_ALL = (ctypes.c_char * 8).from_buffer_copy(struct.pack("HBBI", 6, 0, 0, 0))  # BPF: return 0 bytes of each packet
_libc = ctypes.CDLL(None, use_errno=True)


class Fault(NamedTuple):
    """What happens, to which kinds of process, and how often; ``begin`` returns what ends it, or None.

    harms: what the motor board holds is then not what it was sent; stays: until the end of the round.
    """

    begin: Callable[[Scene, Process, random.Random], Optional[Callable]]
    targets: tuple = ALL
    weight: int = 1
    harms: bool = False
    stays: bool = False


def sends(signum: int) -> Callable:
    return lambda scene, process, chance: process.signal(signum)


def freeze(_scene, process, _chance):
    process.signal(signal.SIGSTOP)
    return lambda: process.signal(signal.SIGCONT)


def limits(kind: int, allowed: Callable[[Process, random.Random], int]) -> Callable:
    """Return a fault that leaves a process what it has, and takes the limit away at its end."""
    def begin(_scene, process, chance):
        hard = resource.prlimit(process.pid, kind)[1]
        resource.prlimit(process.pid, kind, (allowed(process, chance), hard))
        return lambda: process.alive() and resource.prlimit(process.pid, kind, (hard, hard))
    return begin


def present_size(process: Process, chance: random.Random) -> int:
    """Return the size of a process in bytes and up to 9 MB: too little for a thread, now or soon."""
    pages = int(Path(f"/proc/{process.pid}/statm").read_text().split()[0])
    return pages * resource.getpagesize() + chance.randrange(9 << 20)


def descriptors(process: Process, _chance: random.Random) -> int:
    """Return how many file descriptors a process has."""
    return len(os.listdir(f"/proc/{process.pid}/fd"))


def connections(process: Process) -> List[socket.socket]:
    """Return the connected sockets of a process, each a copy that acts on the same connection."""
    pidfd, found = _libc.syscall(SYS_PIDFD_OPEN, process.pid, 0), []
    copies = [_libc.syscall(SYS_PIDFD_GETFD, pidfd, int(number), 0) for number in os.listdir(f"/proc/{process.pid}/fd")]
    if max(copies) < 0:
        raise PermissionError(f"this user may not touch the connections of {process}")
    for copy in filter(lambda copy: copy >= 0, copies):
        try:
            found.append(socket.socket(fileno=copy))
            found[-1].getpeername()
        except OSError:  # it is a file, or listens
            found.pop().close() if found and found[-1].fileno() == copy else os.close(copy)
    os.close(pidfd)
    return found


def cut(act: Callable[[socket.socket], object], undo: Optional[Callable[[socket.socket], object]] = None) -> Callable:
    """Return a fault that does this to all connections of a process, or to some."""
    def begin(_scene, process, chance):
        share = chance.choice((0.3, 1.0))
        broken = [each for each in connections(process) if chance.random() < share and act(each)]
        return undo and (lambda: [undo(each) for each in broken])
    return begin


def close(connection: socket.socket) -> None:
    with contextlib.suppress(OSError):  # the other end was quicker
        connection.shutdown(socket.SHUT_RDWR)


def reset(connection: socket.socket) -> None:
    """Break a TCP connection off: both ends get ECONNRESET."""
    _libc.connect(connection.fileno(), struct.pack("H14x", socket.AF_UNSPEC), 16)


def lose(connection: socket.socket) -> bool:
    """Let nothing more arrive on a TCP connection, as if the cable were cut; return whether it is one."""
    if connection.family == socket.AF_UNIX:
        return False
    connection.setsockopt(socket.SOL_SOCKET, SO_ATTACH_FILTER, struct.pack("HxxxxxxP", 1, ctypes.addressof(DROP_ALL)))
    return True


def find(connection: socket.socket) -> None:
    connection.setsockopt(socket.SOL_SOCKET, SO_DETACH_FILTER, 0)
    connection.close()


def busy_computer(_scene, _process, _chance):
    hogs = [subprocess.Popen([sys.executable, "-c", "while True: pass"]) for _ in range(4)]
    return lambda: [(hog.kill(), hog.wait()) for hog in hogs]


def fills(name: str) -> Callable:
    """Return a fault that fills a disk of the scene."""
    def begin(scene, _process, chance):
        disk = getattr(scene, name)
        if disk not in scene.small_disks:
            raise PermissionError("no small disk")
        filler = disk / f"filler{chance.random()}"
        with contextlib.suppress(OSError), filler.open("wb", buffering=0) as file:
            while True:
                file.write(bytes(4096))
        return lambda: filler.unlink(missing_ok=True)
    return begin


def clock_jump(scene, _process, chance):
    scene.set_clock(chance.choice((-1, 1)) * 10 ** chance.uniform(0, 6))
    return lambda: scene.set_clock(0.0)


def port_again(scene, process, _chance):
    """End a program, and start another one that uses its port at once."""
    process.signal(signal.SIGKILL)
    process.popen.wait()
    scene.command("port", process.robot)


def second_start(scene, process, _chance):
    """Start the same again beside the first one: it must refuse."""
    return must_refuse(scene, process, scene.start("second", *process.command, robot=process.robot))


def second_robot(scene, process, _chance):
    """Start a robot of another name with the same board: it must refuse."""
    command = [each.replace(f"__ns:={process.robot}", "__ns:=second") for each in process.command]
    return must_refuse(scene, process, scene.start("second", *command, robot=process.robot))


def must_refuse(scene: Scene, first: Process, second: Process) -> Callable[[], None]:
    """Return what ends the second one; it raises AssertionError if that runs, although the first one does."""
    def end_second():
        deadline = time.monotonic() + REFUSES
        while second.alive() and first.runs() and scene.master_answers():
            assert time.monotonic() < deadline, f"a second {first} runs: {' '.join(second.command)}"
            time.sleep(0.1)
        second.end()
    return end_second


def restart(scene, process, _chance):
    """Start a robot, or the cockpit, again while it is used."""
    if process.kind == "launch":
        scene.launch(process.robot)
    else:
        process.signal(signal.SIGKILL)
        process.popen.wait()
        scene.start_cockpit()


def read_only_store(scene, _process, _chance):
    remount(scene, "ro")
    return lambda: remount(scene, "rw")


def remount(scene: Scene, mode: str) -> None:
    if scene.store not in scene.small_disks:
        raise PermissionError("no small disk")
    subprocess.run(["mount", "-o", f"remount,{mode}", str(scene.store)], check=True)


FAULTS = {
    "kill": Fault(sends(signal.SIGKILL), (*ALL, "page", "judge"), 6),
    "Ctrl-C": Fault(sends(signal.SIGINT)),
    "closed terminal": Fault(sends(signal.SIGHUP)),
    "freeze": Fault(freeze, (*ALL, "page", "judge"), 5),
    "no thread": Fault(limits(resource.RLIMIT_AS, present_size), LIMITED),
    "no memory": Fault(limits(resource.RLIMIT_DATA, lambda *_: 1 << 20), OURS),
    "no descriptor": Fault(limits(resource.RLIMIT_NOFILE, descriptors), LIMITED),
    "full disk": Fault(fills("disk"), ("computer",)),
    "full disk of the class": Fault(fills("store"), ("class",)),
    "read-only disk of the class": Fault(read_only_store, ("class",)),
    "port again": Fault(port_again, ("commander",)),
    "connections closed": Fault(cut(close), (*LIMITED, "commander")),
    "connections reset": Fault(cut(reset), (*LIMITED, "commander")),
    "connections lost": Fault(cut(lose, find), (*LIMITED, "commander")),
    "clock jump": Fault(clock_jump, ("computer",)),
    "second start": Fault(second_start, ("controller", "launch", "cockpit")),
    "second robot": Fault(second_robot, ("controller",), 2),
    "restart": Fault(restart, ("launch", "cockpit"), 4),
    "busy computer": Fault(busy_computer, ("computer",)),
    "closed lid": Fault(freeze, ("commander", "page"), 5, stays=True),
    "bus off": Fault(bus.off, ("board",)),
    "bus stuck": Fault(bus.stuck, ("board",), harms=True),
    "bus garbage": Fault(bus.garbage, ("board",), harms=True),
    "bus wrong": Fault(bus.wrong, ("board",), harms=True),
    "bus slow": Fault(bus.slow, ("board",)),
    "bus delayed": Fault(bus.delayed, ("board",)),
    "bus intermittent": Fault(bus.intermittent, ("board",)),
    **{name: Fault(begin, ("link",)) for name, begin in link.FATES.items()},
    "frozen subscribers": Fault(bystanders.frozen, ("bystanders",), stays=True),
    "lost subscribers": Fault(bystanders.mute("registerSubscriber", False), ("bystanders",), 2, stays=True),
    "mute subscribers": Fault(bystanders.mute("registerSubscriber", True), ("bystanders",), 2, stays=True),
    "mute publishers": Fault(bystanders.mute("registerPublisher", True), ("bystanders",), stays=True),
}
