"""Where the robots of a class announce themselves in the local network, by multicast DNS; needs zeroconf.

An announcement proves nothing: it only says where to ask.
"""

import contextlib
import threading
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Callable, Dict, List, Optional, Set

SERVICE = "_morbot._tcp.local."
INTERVAL = 2.0  # s between two looks at this computer's addresses
TIMEOUT = 3000  # ms for the address of a robot
MAX_ASKED = 64  # at the same time: anybody may announce what has no address
MAX_FOUND = 64  # the newest: anybody may announce many


class Finder:
    """Looks for the robots in a thread of its own. addresses: returns this computer's, which a network may change."""

    def __init__(self, class_name: str, addresses: Callable[[], List[str]]):
        self._class_name, self._addresses = class_name, addresses
        self._found: Dict[str, str] = {}  # HOST:PORT, by the name of the service; the newest last
        self._lock, self._askers = threading.Lock(), ThreadPoolExecutor(MAX_ASKED)
        self._ended = threading.Event()
        try:
            import zeroconf  # here: not every computer has it
        except ImportError:
            return
        self._zeroconf = zeroconf
        threading.Thread(target=self._run, daemon=True).start()

    def found(self) -> Set[str]:
        """Return HOST:PORT of each robot that says it is of this class."""
        with self._lock:
            return set(list(self._found.values())[-MAX_FOUND:])

    def close(self) -> None:
        """Look no more."""
        self._ended.set()

    def _run(self):
        before: Optional[List[str]] = None
        browsing: Any = None
        while not self._ended.wait(0 if before is None else INTERVAL):
            now = sorted(self._addresses())
            if now != before:
                before, browsing = now, self._browse_again(browsing)
        self._close(browsing)

    def _browse_again(self, browsing):
        """Use the interfaces that there are now."""
        self._close(browsing)
        with contextlib.suppress(OSError):  # no network
            browsing = self._zeroconf.Zeroconf()
            self._zeroconf.ServiceBrowser(browsing, SERVICE, handlers=[self._on_change])
            return browsing
        return None

    def _close(self, browsing):
        if browsing:
            with contextlib.suppress(OSError):
                browsing.close()

    def _on_change(self, zeroconf, service_type, name, state_change):
        if state_change is self._zeroconf.ServiceStateChange.Removed:
            self._keep(name, None)
        else:
            self._askers.submit(self._ask, zeroconf, service_type, name)

    def _ask(self, zeroconf, service_type, name):
        info = zeroconf.get_service_info(service_type, name, TIMEOUT)
        address = address_of(info, self._class_name) if info else None
        if address:
            self._keep(name, address)

    def _keep(self, name, address):
        with self._lock:
            self._found.pop(name, None)
            if address:
                self._found[name] = address


def address_of(info: Any, class_name: str) -> Optional[str]:
    """Return HOST:PORT of a zeroconf.ServiceInfo of this class, or None."""
    addresses = [each for each in info.parsed_addresses() if ":" not in each]  # IPv6 may be of one interface only
    is_ours = (info.properties or {}).get(b"class") == class_name.encode()
    return f"{addresses[0]}:{info.port}" if is_ours and addresses and info.port else None
