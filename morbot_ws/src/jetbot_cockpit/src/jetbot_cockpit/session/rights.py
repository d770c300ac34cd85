"""Who is at a page, and what that lets a person do."""

from typing import NamedTuple, Optional

from ..notices import Notice, say
from .messages import FROM_PAGE
from .protocol import Message
from .snapshot import Snapshot

PUPIL, TEACHER = "pupil", "teacher"


class Client(NamedTuple):
    """Somebody at a page. role: PUPIL or TEACHER; robot: the only one that a pupil may drive, None: any."""

    id: int
    role: str
    robot: Optional[str] = None

    @property
    def name(self) -> Notice:
        """What a person is called who has no other name."""
        return say(self.role, number=self.id)

    def may_drive(self, robot: str) -> bool:
        """Return whether this person may drive the robot."""
        return self.role == TEACHER or self.robot in (None, robot)

    def may_stop(self, robot: Optional[str]) -> bool:
        """Return whether this person may stop the robot, or all (None): anybody stops all."""
        return self.role == TEACHER or robot in (None, self.robot)


class Request(NamedTuple):
    """What a client asks for, and when, in monotonic seconds. snapshot: of the robots, as of the last check."""

    client: Client
    message: Message
    snapshot: Snapshot
    now: float

    @property
    def robot(self) -> Optional[str]:
        """The robot that it is about; None: all."""
        return self.message.robot


def refuse_role(client: Client, kind: str) -> Optional[Notice]:
    """Return why somebody of this role may not send such a message, or None."""
    return say(f"teacher_{kind}") if FROM_PAGE[kind].teacher and client.role != TEACHER else None
