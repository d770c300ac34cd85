"""Where the robots of a class announce themselves in the local network, by multicast DNS; needs zeroconf.

An announcement proves nothing: it only says where to ask.
"""

import contextlib
import threading
from typing import Any, Callable, Dict, List, Optional, Set

SERVICE = "_morbot._tcp.local."
INTERVAL = 2.0  # s between two looks at this computer's addresses
TIMEOUT = 3000  # ms for the address of a robot


class Finder:
    """Looks for the robots in a thread of its own. addresses: returns this computer's, which a network may change."""

    def __init__(self, class_name: str, addresses: Callable[[], List[str]]):
        self._class_name, self._addresses = class_name, addresses
        self._found: Dict[str, str] = {}  # HOST:PORT, by the name of the service; replaced, never changed
        self._ended = threading.Event()
        try:
            import zeroconf  # here: not every computer has it
        except ImportError:
            return
        self._zeroconf = zeroconf
        threading.Thread(target=self._run, daemon=True).start()

    def found(self) -> Set[str]:
        """Return HOST:PORT of each robot that says it is of this class."""
        return set(self._found.values())

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
            self._found = {other: address for other, address in self._found.items() if other != name}
            return
        info = zeroconf.get_service_info(service_type, name, TIMEOUT)
        address = address_of(info, self._class_name) if info else None
        if address:
            self._found = {**self._found, name: address}


def address_of(info: Any, class_name: str) -> Optional[str]:
    """Return HOST:PORT of a zeroconf.ServiceInfo of this class, or None."""
    addresses = [each for each in info.parsed_addresses() if ":" not in each]  # IPv6 may be of one interface only
    is_ours = (info.properties or {}).get(b"class") == class_name.encode()
    return f"{addresses[0]}:{info.port}" if is_ours and addresses and info.port else None
