"""A client at a page: what its page shows, and how much it may send. Times are monotonic seconds."""

from collections import Counter
from typing import Callable, List, NamedTuple, Optional, Sequence

from ..notices import Notice, say
from .curves import Curves
from .feed import Feed, Picture
from .messages import MAX_BURST, MAX_RATE
from .protocol import dumps, notice
from .rights import TEACHER, Client

STILL_INTERVAL = 1.0    # s between two frames while nothing changes, and between two pings
ABSENT_AFTER = 3.0      # s without a sign of life: frames would only queue up


class PageOwner(NamedTuple):
    """Whose pages share places and limits: the label of a code, and an address. One code may be a whole class's."""

    code: str
    address: str


class Viewer:
    """A client with a socket (web.handlers.Socket), and what its page shows."""

    def __init__(self, client: Client, owner: PageOwner, connection, now: float):
        self.client, self.owner, self.connection = client, owner, connection
        self.allowance = float(MAX_BURST)  # messages that it may send now
        self.active_at = self.pinged_at = self.shown_at = now
        self.state = self.robots = ""
        self.problem: Optional[Notice] = None
        self.frames = True  # whether it wants "robots" and "state"
        self.is_done = False  # it was disconnected, and has stopped since: nothing more of it counts
        self.feed, self.curves = Feed(), Curves()

    def record_activity(self, now: float) -> bool:
        """Record a sign of life; return whether there are not too many: MAX_RATE, after a pause MAX_BURST at once."""
        refilled = self.allowance + (now - self.active_at) * MAX_RATE
        self.allowance = min(MAX_BURST, refilled) - 1
        self.active_at = now
        return self.allowance >= 0

    def show_picture(self, picture: Optional[Picture], pause: float, now: float) -> None:
        """Send a part of the newest picture, if it is due. What acknowledges it is within the limit of messages."""
        for message in [] if self.connection.is_backlogged() else self.feed.next(picture, pause, now):
            self.connection.send(message if isinstance(message, bytes) else dumps(message))
            self.allowance += isinstance(message, bytes)

    def answer(self, reply: Optional[dict]) -> None:
        """Send this, unless what was sent before is still waiting."""
        if reply and not self.connection.is_backlogged():
            self.connection.send(dumps(reply))

    def is_ready(self, now: float) -> bool:
        """Return whether the page takes what it is sent; a frozen browser or a bad network does not."""
        return now - self.active_at < ABSENT_AFTER and not self.connection.is_backlogged()

    def show(self, robots: str, changes: List[str], state: str, history: Callable[[], List[dict]], now: float) -> None:
        """Send what the page does not show yet. history: returns what only a new page needs."""
        texts = changes if self.robots else list(map(dumps, history()))
        for text in texts if self.robots == robots or not self.frames else [robots, *texts]:
            self.connection.send(text)
        self.robots = robots
        if self.frames and (state != self.state or now - self.shown_at >= STILL_INTERVAL):
            self.connection.send(state)
            self.state, self.shown_at = state, now

    def show_curves(self, readings: Callable) -> None:
        """Send what is new of the robot whose curves the page draws. readings: of session.control.Control."""
        message = self.curves.next(readings)
        if message:
            self.connection.send(dumps(message))

    def warn(self, problem: Optional[Notice]) -> None:
        """Tell a teacher once why the class is not kept, and when it is again: None."""
        if problem != self.problem and self.client.role == TEACHER:
            self.connection.send(dumps(notice(problem or say("class_kept_again"))))
        self.problem = problem


def most_crowding(viewers: Sequence[Viewer]) -> Viewer:
    """Return who leaves when there is no room: the newest page of the code that has the most pages.

    If one code has them at several addresses: at the address that has the most. A teacher's goes last.
    """
    codes, owners = (Counter(each) for each in zip(*((viewer.owner.code, viewer.owner) for viewer in viewers)))
    return max(viewers, key=lambda viewer: (codes[viewer.owner.code], owners[viewer.owner],
                                            viewer.client.role != TEACHER, viewer.client.id))
