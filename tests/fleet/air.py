#!/usr/bin/env python3
"""The router of a school: carries Ethernet frames between the hosts, as a switch whose links can be bad.

A process of its own, for the kernels that have no netem(8): each host's eth0 is a TAP device. Commands are JSON lines,
[NAME, ARGUMENT, ...]; each is answered by a line once it is obeyed. It ends with its stdin.
"""

import contextlib
import ctypes
import fcntl
import heapq
import itertools
import json
import os
import random
import select
import struct
import sys
import time
from pathlib import Path
from typing import Dict, List, NamedTuple, Optional, Tuple

sys.path.append(str(Path(__file__).parents[1] / "chaos"))
from link import IFF_NO_PI, TUNSETIFF  # noqa: E402

IFF_TAP = 0x0002  # linux/if_tun.h
CLONE_NEWNET = 0x40000000  # linux/sched.h
MAX_FRAME = 65536
MULTICAST = 1  # in a MAC address's first byte
_setns = ctypes.CDLL(None, use_errno=True).setns


def enter(pid: int) -> None:
    """Let this thread use the network of another process. Raises OSError."""
    with open(f"/proc/{pid}/ns/net") as network:
        if _setns(network.fileno(), CLONE_NEWNET):
            raise OSError(ctypes.get_errno(), "setns")


class Fate(NamedTuple):
    """What happens to frames: the share that is lost, and how late the others are, in s."""

    loss: float = 0.0
    delay: float = 0.0
    jitter: float = 0.0

    def draw(self) -> Optional[float]:
        """Return the delay of one frame in s, or None if it is lost."""
        if random.random() < self.loss:
            return None
        return max(0.0, self.delay + random.uniform(-self.jitter, self.jitter))


class Switch:
    """All ports, by the hosts' numbers."""

    def __init__(self):
        self._devices: Dict[int, int] = {}  # their files, by port
        self._fates: Dict[int, Tuple[Fate, Fate]] = {}  # to and from the host
        self._ports: Dict[bytes, int] = {}  # by the MAC address that was seen there
        self._waiting: List[tuple] = []  # frames with the times at which they are due
        self._count = itertools.count()

    def join(self, port: int, pid: int) -> None:
        """Give the process's network a device, eth0."""
        enter(pid)
        device = os.open("/dev/net/tun", os.O_RDWR | os.O_CLOEXEC | os.O_NONBLOCK)
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH14x", b"eth0", IFF_TAP | IFF_NO_PI))
        self.leave(port)
        self._devices[port], self._fates[port] = device, (Fate(), Fate())

    def leave(self, port: int) -> None:
        """Remove a host's device."""
        if port in self._devices:
            os.close(self._devices.pop(port))

    def spoil(self, port: int, to_host: List[float], from_host: List[float]) -> None:
        """Set the fates of frames."""
        self._fates[port] = Fate(*to_host), Fate(*from_host)

    def carry(self) -> None:
        """Serve until stdin ends."""
        while True:
            due = self._waiting[0][0] - time.monotonic() if self._waiting else None
            ready, _, _ = select.select([sys.stdin, *self._devices.values()], [], [], due and max(0.0, due))
            if sys.stdin in ready and not self._obey(sys.stdin.readline()):
                return
            for port in [port for port, device in self._devices.items() if device in ready]:
                self._take(port)
            while self._waiting and self._waiting[0][0] <= time.monotonic():
                _, _, port, frame = heapq.heappop(self._waiting)
                with contextlib.suppress(OSError, KeyError):  # the host is down, or was switched off
                    os.write(self._devices[port], frame)

    def _obey(self, line):
        if line:
            name, *arguments = json.loads(line)
            getattr(self, name)(*arguments)
            print("done", flush=True)
        return line

    def _take(self, port):
        try:
            frame = os.read(self._devices[port], MAX_FRAME)
        except BlockingIOError:
            return
        except OSError:  # the host was switched off
            self.leave(port)
            return
        to, source = frame[:6], frame[6:12]
        self._ports[source] = port
        known = self._ports.get(to)
        everybody = to[0] & MULTICAST or known is None
        for each in [each for each in self._devices if each != port] if everybody else [known]:
            delays = self._fates[port][1].draw(), self._fates[each][0].draw()
            if None not in delays:
                heapq.heappush(self._waiting, (time.monotonic() + sum(delays), next(self._count), each, frame))


if __name__ == "__main__":
    Switch().carry()
