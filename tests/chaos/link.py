"""The cable between the pages and the cockpit: a TUN device, so that its packets can be lost, late, and out of order.

Whoever connects to FAR reaches this computer: each packet comes back with its two addresses exchanged, which changes
no checksum.
"""

import contextlib
import fcntl
import heapq
import os
import random
import select
import struct
import subprocess
import threading
import time
from typing import Callable, List, Optional, Tuple

ISOLATED = "CHAOS_ISOLATED" in os.environ  # whether mounts, network devices and ports are our own
IFF_TUN, IFF_NO_PI, TUNSETIFF = 0x0001, 0x1000, 0x400454CA  # linux/if_tun.h
SOURCE, DESTINATION, TO_PORT = slice(12, 16), slice(16, 20), slice(22, 24)  # of an IPv4 packet without options
NEAR, FAR = "10.77.{}.1", "10.77.{}.2"
LOSS = 0.3
DELAY = 0.08  # s at most, of packets that overtake each other

Fate = Callable[[bool], Optional[float]]  # whether a packet goes to the cockpit: its delay in s, None: it is lost


class Link:
    """The pages reach the cockpit at ``address``. Without the right to make a device, it cannot be broken."""

    def __init__(self, number: int, port: int):
        self._port, self.address = struct.pack("!H", port), "127.0.0.1"
        self._broken: List[Tuple[Fate, bool]] = []
        self._device: Optional[int] = None
        if ISOLATED:  # else the device would be one of this computer
            with contextlib.suppress(OSError, subprocess.CalledProcessError):
                self._open(f"chaos{number}", NEAR.format(number), FAR.format(number))

    def _open(self, name, near, far):
        device = os.open("/dev/net/tun", os.O_RDWR | os.O_CLOEXEC)
        fcntl.ioctl(device, TUNSETIFF, struct.pack("16sH14x", name.encode(), IFF_TUN | IFF_NO_PI))
        subprocess.run(["ip", "address", "add", near, "peer", far, "dev", name], check=True)
        subprocess.run(["ip", "link", "set", name, "up"], check=True)
        self._device, self.address = device, far
        threading.Thread(target=self._carry, daemon=True).start()

    def break_off(self, fate: Fate, passes: bool = True) -> Callable[[], None]:
        """Treat packets like this; return what repairs it. Raise PermissionError where there is no device."""
        if self._device is None:
            raise PermissionError("no TUN device")
        broken = fate, passes
        self._broken.append(broken)
        return lambda: self._broken.remove(broken)

    @property
    def passes(self) -> bool:
        """Whether commands reach the cockpit."""
        return all(passes for _, passes in self._broken)

    def _carry(self):
        waiting, device = [], self._device  # packets with the times at which they are due
        while self._device is not None:
            due = waiting[0][0] - time.monotonic() if waiting else 0.2
            if select.select([device], [], [], max(0.0, min(0.2, due)))[0]:
                packet = bytearray(os.read(device, 65536))
                delays = [fate(packet[TO_PORT] == self._port) for fate, _ in list(self._broken)]
                if packet[0] >> 4 == 4 and None not in delays:
                    packet[SOURCE], packet[DESTINATION] = packet[DESTINATION], packet[SOURCE]
                    heapq.heappush(waiting, (time.monotonic() + sum(delays), bytes(packet)))
            while waiting and waiting[0][0] <= time.monotonic():
                os.write(device, heapq.heappop(waiting)[1])
        os.close(device)

    def close(self) -> None:
        """Remove the device."""
        self._device = None


def breaks(fate: Fate, passes: bool = True) -> Callable:
    """Return the fault that does this to the packets of a scene's pages."""
    return lambda scene, process, chance: scene.link.break_off(fate, passes)


FATES = {
    "link cut": breaks(lambda to_cockpit: None, passes=False),
    "link half-open": breaks(lambda to_cockpit: None if to_cockpit else 0.0, passes=False),
    "link half-open, to the page": breaks(lambda to_cockpit: 0.0 if to_cockpit else None),
    "link loses 30 %": breaks(lambda to_cockpit: None if random.random() < LOSS else 0.0),
    "link reorders": breaks(lambda to_cockpit: random.uniform(0, DELAY)),
}
