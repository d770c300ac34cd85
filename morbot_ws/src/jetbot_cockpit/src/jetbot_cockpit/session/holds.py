"""Robots that teachers keep waiting."""

from typing import Dict, Iterable, Optional

from .rights import TEACHER, Client

TAKEN, STOPPED = "robot", "programs"  # what a teacher keeps waiting: pupils and programs, or programs alone


class Holds:
    """Robots that teachers have taken or stopped: they wait until a teacher gives them back, whoever comes and goes.

    drivers: what lets their programs wait (robots.command_publishers.Drivers).
    """

    def __init__(self, drivers):
        self._drivers = drivers
        self._held: Dict[str, str] = {}  # TAKEN or STOPPED, by robot
        self._all = False  # whether robots that come are held, too: a teacher's stop of all is engaged

    def __getitem__(self, robot: str) -> Optional[str]:
        """Return TAKEN, STOPPED, or None for a robot that no teacher holds."""
        return self._held.get(robot)

    def is_taken_from(self, client: Client, robot: str) -> bool:
        """Return whether a teacher has taken the robot, and this person is no teacher."""
        return client.role != TEACHER and self._held.get(robot) == TAKEN

    def take(self, robot: str) -> None:
        """A teacher takes the robot."""
        self._held[robot] = TAKEN
        self._drivers.keep_waiting(robot, True)

    def stop(self, robots: Iterable[str], all_robots: bool) -> None:
        """A teacher stops these robots. all_robots: and those that come until the release."""
        self._all = self._all or all_robots
        for robot in robots:
            self._held.setdefault(robot, STOPPED)
            self._drivers.keep_waiting(robot, True)

    def update(self, emergency: bool, comers: Iterable[str]) -> None:
        """Hold the robots that have come as well, while a teacher's stop of all is engaged."""
        self._all = self._all and emergency
        if self._all:
            self.stop(comers, True)

    def give_back(self, robot: Optional[str]) -> None:
        """Let this robot, or all (None), go on."""
        for each in list(self._held) if robot is None else [robot]:
            if self._held.pop(each, None):
                self._drivers.keep_waiting(each, False)
