"""How many connections there may be, and for how long. No sockets and no clock here."""

from typing import Dict, List, NamedTuple, Protocol

MAX_CONNECTIONS = 256   # a process may have 1,024 files, and the ROS side needs some
MAX_PER_ADDRESS = 100   # one computer leaves room for the others; a class may share an address
MAX_REQUEST_TIME = 30.0  # s for a request and its answer, until the connection is a client's socket


class Stream(Protocol):
    """The part of tornado.iostream.IOStream that is needed here."""

    def close(self) -> None: ...

    def closed(self) -> bool: ...


class Opened(NamedTuple):
    """From where and when a connection was opened; kept: it became a client's socket."""

    address: str
    time: float
    kept: bool = False


class Connections:
    """All connections that are open."""

    def __init__(self):
        self._opened: Dict[Stream, Opened] = {}

    def admit(self, stream: Stream, address: str, now: float) -> None:
        """Count a new connection from this address; if there is no room, close the oldest. now: in s."""
        self._opened = {each: opened for each, opened in self._opened.items() if not each.closed()}
        neighbours = [each for each, opened in self._opened.items() if opened.address == address]
        if len(neighbours) >= MAX_PER_ADDRESS:
            self._make_room(neighbours)
        if len(self._opened) >= MAX_CONNECTIONS:
            self._make_room(list(self._opened))
        self._opened[stream] = Opened(address, now)

    def keep(self, stream: Stream) -> None:
        """Let a connection stay open: it is a client's socket."""
        if stream in self._opened:
            self._opened[stream] = self._opened[stream]._replace(kept=True)

    def expire(self, now: float) -> None:
        """Close what takes too long: whoever sends or reads too slowly, or not at all."""
        for stream, opened in self._opened.items():
            if not opened.kept and now - opened.time > MAX_REQUEST_TIME:
                stream.close()

    def _make_room(self, streams: List[Stream]) -> None:
        """Close the oldest of these that is no client's socket: half-open ones shut nobody out."""
        oldest = next((stream for stream in streams if not self._opened[stream].kept), None)
        if oldest:
            del self._opened[oldest]
            oldest.close()

    def close(self) -> None:
        """Close all connections."""
        for stream in self._opened:
            stream.close()
