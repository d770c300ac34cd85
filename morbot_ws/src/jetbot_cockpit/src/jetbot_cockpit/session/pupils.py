"""The names of the pupils, by the robots whose codes they have."""

from typing import Any, Callable, Dict, Mapping, Optional

from jetbot.text import is_printable
from jetbot_ros.contract import MAX_NAME

from ..notices import Notice
from .rights import Client, Request


class Pupils:
    """kept: what ``keep`` was called with after the last change."""

    def __init__(self, kept: Mapping[str, Any], keep: Callable[[Dict[str, str]], None]):
        self._names = {robot: name for robot, name in kept.items() if is_printable(name, MAX_NAME)}
        self._typed: Dict[int, str] = {}  # the names that people have typed, by client
        self._keep = keep

    def __getitem__(self, robot: Optional[str]) -> str:
        """Return the name that a teacher has given to the robot's pupil, or ""."""
        return self._names.get(robot, "") if robot else ""

    def name(self, request: Request) -> Optional[Notice]:
        """Give the robot's pupil a name, or none if it is ""."""
        ended = request.snapshot.ended(request.robot)
        if not ended:
            names = {**self._names, request.robot: request.message.name.strip()}
            self._names = {robot: name for robot, name in names.items() if name}
            self._keep(self._names)
        return ended

    def rename(self, request: Request) -> None:
        """Call the client by the name that the person has typed."""
        self._typed[request.client.id] = request.message.name.strip()

    def called(self, client: Client) -> str:
        """Return the teacher's name for this person, else the one that was typed, or ""."""
        return self[client.robot] or self._typed.get(client.id, "")

    def leave(self, client: int) -> None:
        """The client's socket is closed."""
        self._typed.pop(client, None)
