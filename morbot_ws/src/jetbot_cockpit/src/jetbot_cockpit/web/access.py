"""Who gets in: codes, cookies, wrong tries, and where a request may come from."""

import hmac
import math
import secrets
from collections import deque
from types import MappingProxyType
from typing import Any, Deque, Iterable, List, Mapping, NamedTuple, Optional, Sequence, Set, Tuple

from jetbot.host import is_loopback

from ..session.rights import PUPIL, TEACHER

ALPHABET = "ABCDEFGHJKMNPQRSTUVWXYZ23456789"  # none that looks like another
CODE_LENGTH = {PUPIL: 6, TEACHER: 10}
COOKIE_LENGTH = 43  # characters of 32 random bytes
LOOPBACK = ("localhost", "127.0.0.1", "::1")
MINUTE = 60.0              # s, in which wrong codes are counted
MAX_WRONG = 5              # wrong codes from one browser in that time: a class may share one address
MAX_WRONG_AT_ADDRESS = 30  # from all browsers at one address: one may take a new cookie for each try
MAX_REMEMBERED = 10000     # wrong codes


class TooManyTries(Exception):
    """So many codes were wrong that no code is accepted for now."""


class Grant(NamedTuple):
    """What a code gives: a role, and for a pupil perhaps the only robot to drive. cookie: what is kept instead."""

    label: str
    role: str
    robot: Optional[str]
    code: str
    cookie: str


def make_grant(label: str, role: str, robot: Optional[str] = None, kept: Any = None) -> Grant:
    """Return a grant with a new code and a new cookie, or with those that were kept, if they are some."""
    code = "".join(secrets.choice(ALPHABET) for _ in range(CODE_LENGTH[role]))
    return Grant(label, role, robot, *(kept if are_secrets(kept, role) else (code, secrets.token_urlsafe(32))))


def are_secrets(kept: Any, role: str) -> bool:
    """Return whether this is a code and a cookie for such a role."""
    return (isinstance(kept, list) and len(kept) == 2 and all(isinstance(each, str) for each in kept)
            and len(kept[0]) == CODE_LENGTH[role] and set(kept[0]) <= set(ALPHABET) and len(kept[1]) >= COOKIE_LENGTH)


def numbered(robots: int) -> List[str]:
    """Return jetbot_01, jetbot_02 and so on."""
    return [f"jetbot_{number:02d}" for number in range(1, robots + 1)]


def make_grants(names: Sequence[str], kept: Mapping[str, Any] = MappingProxyType({})) -> List[Grant]:
    """Return the teacher's grant, and one for each of these robots; without any, one for all pupils.

    kept: [code, cookie] of earlier grants, by their labels.
    """
    pupils = [(name, PUPIL, f"/{name}") for name in names] or [("pupils", PUPIL, None)]
    return [make_grant(*each, kept.get(each[0])) for each in [("teacher", TEACHER, None), *pupils]]


def authority(host: str, port: int) -> str:
    """Return HOST:PORT as a browser writes it in Host and Origin: without http's own port, 80."""
    host = f"[{host}]" if ":" in host else host.lower()
    return host if port == 80 else f"{host}:{port}"


def dialled(host: str, port: int) -> str:
    """Return an IP address and a port as both ends of a connection know them: without the name of an interface."""
    return authority(host.partition("%")[0], port)


class Access:
    """Decides who gets in. names: by which others reach this computer, beside the addresses that they connect to.

    grants: by which codes; the list may change.
    """

    def __init__(self, port: int, names: Iterable[str], grants: Sequence[Grant]):
        self.cookie_name = f"jetbot_cockpit_{port}"  # a host's ports share their cookies
        self.visitor_cookie = f"{self.cookie_name}_visitor"  # tells browsers behind one address apart
        self._port, self._names, self._grants = port, (*LOOPBACK, *names), grants
        self._this_computer = make_grant("this computer", TEACHER)
        self._wrong: Deque[Tuple[float, str, Optional[str]]] = deque(maxlen=MAX_REMEMBERED)  # (when, peer, visitor)
        self._refused: Deque[str] = deque(maxlen=MAX_REMEMBERED)  # addresses that were refused, for the log
        self._logged_at = -math.inf

    def accepts_host(self, host: Optional[str], address: str) -> bool:
        """Return whether a Host header names this page. address: the one of this computer that the client reached.

        Without that, a foreign page whose name is resolved to this address (DNS rebinding) would pass as this one.
        """
        return host is not None and host.lower() in self._authorities(address)

    def accepts_origin(self, origin: Optional[str], address: str) -> bool:
        """Return whether an Origin header names this page; also False without one, so that no foreign page acts."""
        return origin in {f"http://{each}" for each in self._authorities(address)}

    def grant(self, cookie: Optional[str], peer: str, host: Optional[str]) -> Optional[Grant]:
        """Return what the sender of a request may do, or None for somebody without access.

        This computer's own browser needs no cookie. peer: the sender's address; host: the accepted Host header.
        """
        if is_loopback(peer) and host in {authority(each, self._port) for each in LOOPBACK}:
            return self._this_computer
        return self._find("cookie", cookie or "")

    def log_in(self, code: str, peer: str, visitor: Optional[str], now: float) -> Optional[Grant]:
        """Return what a code gives, or None for a wrong one. visitor: the browser's cookie; now: in s, from any start.

        Raise TooManyTries. Nobody's wrong codes count at another address.
        """
        while self._wrong and now - self._wrong[0][0] >= MINUTE:
            self._wrong.popleft()
        browsers = [browser for _, address, browser in self._wrong if address == peer]
        if browsers.count(visitor) >= MAX_WRONG or len(browsers) >= MAX_WRONG_AT_ADDRESS:
            self._refused.append(peer)
            raise TooManyTries
        grant = self._find("code", "".join(each for each in code.upper() if each in ALPHABET))
        if not grant:
            self._wrong.append((now, peer, visitor))
        return grant

    def take_log(self, now: float) -> List[str]:
        """Return what the terminal should report: at most one line per minute."""
        if not self._refused or now - self._logged_at < MINUTE:
            return []
        self._logged_at = now
        addresses = sorted({self._refused.popleft() for _ in range(len(self._refused))})
        others = {1: "", 2: " and another address"}.get(len(addresses), f" and {len(addresses) - 1} other addresses")
        return [f"too many wrong codes from {addresses[0]}{others}: refused for a minute"]

    def _find(self, field: str, text: str) -> Optional[Grant]:
        # All are compared, each in constant time: the duration says nothing about them
        found = [each for each in self._grants if hmac.compare_digest(
            getattr(each, field).encode(), text.encode(errors="replace"))]
        return found[0] if found else None

    def _authorities(self, address: str) -> Set[str]:
        return {authority(each, self._port) for each in (*self._names, address.partition("%")[0])}
