"""Somebody at a page."""

from typing import NamedTuple, Optional

PUPIL, TEACHER = "pupil", "teacher"


class Client(NamedTuple):
    """Somebody at a page. role: PUPIL or TEACHER; robot: the only one that a pupil may drive, None: any."""

    id: int
    name: str
    role: str
    robot: Optional[str] = None

    def may_drive(self, robot: str) -> bool:
        """Return whether this person may drive the robot."""
        return self.role == TEACHER or self.robot in (None, robot)

    def may_stop(self, robot: Optional[str]) -> bool:
        """Return whether this person may stop the robot, or all (None): anybody stops all."""
        return self.role == TEACHER or robot in (None, self.robot)
