"""Who may engage and release which emergency stop: that of all robots (None), or that of one."""

from typing import Optional, Set

from .client import TEACHER, Client
from .view import Snapshot


class Stops:
    """A stop that a teacher has engaged is released by a teacher; any other by anybody who may engage it."""

    def __init__(self):
        self._teachers: Set[Optional[str]] = set()

    def stop(self, client: Client, robot: Optional[str]) -> str:
        """Return why the client may not stop this robot, or ""."""
        if not client.may_stop(robot):
            return "Only a teacher can stop a single robot. You can stop all."
        if client.role == TEACHER:
            self._teachers.add(robot)
        return ""

    def release(self, client: Client, robot: Optional[str]) -> str:
        """Return why the client may not release this robot, or ""."""
        if not client.may_stop(robot):
            return "Only a teacher can release a single robot."
        if client.role != TEACHER and robot in self._teachers:
            return "A teacher stopped this. Only a teacher can release it."
        self._teachers.discard(robot)
        return ""

    def update(self, snapshot: Snapshot) -> None:
        """Forget the stops that somebody else has released, with ROS."""
        self._teachers = set(filter(snapshot.is_stopped, self._teachers))
