"""A school's network on this computer: hosts, each in Linux namespaces of its own, and the router that joins them.

A host's first process holds its namespaces, and the kernel ends all others in them when that one ends: by ``kill``,
or because these tests were killed. Nothing of a host is left then: no process, device or mount.
"""

import json
import os
import signal
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Callable, Dict, List

from air import Fate, enter

from processes import end_with_parent, start

SUBNET = "10.77.0"
PAGES = 20  # that may connect at once
GOOD, CUT = Fate(), Fate(loss=1.0)
HOLD = 'mount -t tmpfs tmpfs /run && ip link set lo up && hostname "$0" && echo ready && exec sleep infinity'
NAMESPACES = ["--net", "--pid", "--mount", "--uts"]


class NotAllowed(Exception):
    """This user may not make network namespaces here."""


class Router:
    """The process that carries all packets. Raise NotAllowed."""

    def __init__(self):
        self._process = subprocess.Popen([sys.executable, str(Path(__file__).with_name("air.py"))], text=True,
                                         stdin=subprocess.PIPE, stdout=subprocess.PIPE, preexec_fn=end_with_parent)

    def order(self, *command: object) -> None:
        """Let the router obey a command of air.Switch."""
        self._process.stdin.write(json.dumps(command) + "\n")
        self._process.stdin.flush()
        if not self._process.stdout.readline():
            raise NotAllowed

    def close(self) -> None:
        """Switch it off."""
        self._process.stdin.close()
        self._process.wait()
        self._process.stdout.close()


class Host:
    """A computer in the network. number: of its port at the router, and of its address at first."""

    def __init__(self, router: Router, name: str, number: int):
        self.name, self._router, self._port = name, router, number
        self._holder = subprocess.Popen(
            ["unshare", *NAMESPACES, "--fork", "--kill-child", "--mount-proc", "sh", "-c", HOLD,
             name.replace("_", "-")], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True,
            preexec_fn=lambda: end_with_parent(signal.SIGKILL))  # unshare blocks SIGTERM
        if not self._holder.stdout.readline():
            raise NotAllowed
        self._pid = int(Path(f"/proc/{self._holder.pid}/task/{self._holder.pid}/children").read_text().split()[0])
        self._inside = ThreadPoolExecutor(PAGES, initializer=enter, initargs=[self._pid])
        router.order("join", number, self._pid)
        self.move(number)

    def run(self, *command: str) -> str:
        """Run a command to its end; return what it prints. Raise CalledProcessError."""
        return subprocess.run(self._here(*command), check=True, stdout=subprocess.PIPE, text=True).stdout

    def start(self, command: List[str], log: Path, environment: Dict[str, str]) -> subprocess.Popen:
        """Start a process here."""
        return start(self._here(*command), log, env=environment)

    def call(self, function: Callable, *arguments: object):
        """Return what the function returns in a thread of this host: the sockets that it makes are of this network."""
        return self._inside.submit(function, *arguments).result()

    def _here(self, *command):
        return ["nsenter", "--target", str(self._pid), *NAMESPACES, "--", *command]

    def spoil(self, to_host: Fate = GOOD, from_host: Fate = GOOD) -> None:
        """Let this happen to all packets in these directions."""
        self._router.order("spoil", self._port, to_host, from_host)

    def set_link(self, state: str) -> None:
        """Leave the network ("down"), or come back ("up")."""
        self.run("ip", "link", "set", "eth0", state)

    def move(self, number: int) -> None:
        """Come back with another address, which all learn, as from DHCP."""
        self.address = f"{SUBNET}.{number}"
        self.run("sh", "-c", "echo 1 >/proc/sys/net/ipv4/conf/eth0/arp_notify; ip link set eth0 down; ip address flush "
                 f"dev eth0; ip address add {self.address}/24 dev eth0; ip link set eth0 up")

    def kill(self) -> None:
        """End all that runs here, at once."""
        os.kill(self._pid, signal.SIGKILL)

    def close(self) -> None:
        """Remove a host that was killed."""
        self._holder.wait()
        self._holder.stdout.close()
        self._inside.shutdown()
        self._router.order("leave", self._port)
