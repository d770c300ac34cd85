"""The emergency stops: that of all robots (None), and each robot's own. Who engages and who releases them."""

from typing import Optional, Set

from ..notices import Notice, say
from .holds import Holds
from .rights import TEACHER, Client, Request
from .snapshot import Snapshot


class Stops:
    """A pupil releases only what pupils alone have engaged here: no stop by a teacher, and none from a terminal.

    robots: what engages them (robots.discovery.Robots); holds: what waits after a teacher's stop.
    """

    def __init__(self, robots, holds: Holds):
        self._robots, self._holds = robots, holds
        self._by_pupils: Set[Optional[str]] = set()

    def engage(self, client: Client, robot: Optional[str], snapshot: Snapshot) -> Optional[Notice]:
        """Stop the robot, or all; return why the client may not, or None. Nothing else of the session delays it."""
        refusal = snapshot.ended(robot) or (None if client.may_stop(robot) else say("teacher_stops_one"))
        if refusal:
            return refusal
        self._robots.set_emergency_stop(robot, True)
        if client.role == TEACHER:
            self._by_pupils.discard(robot)
            self._holds.stop(snapshot.robots if robot is None else [robot], robot is None)
        elif not snapshot.may_be_stopped(robot):
            self._by_pupils.add(robot)
        return None

    def release(self, request: Request) -> Optional[Notice]:
        """End the stop of the robot, or of all; return why the client may not, or None."""
        client, robot = request.client, request.robot
        if not client.may_stop(robot):
            return say("teacher_releases_one")
        stopped = request.snapshot.is_stopped(robot)
        if client.role != TEACHER and robot not in self._by_pupils:
            return say("teacher_releases" if stopped else "not_stopped")
        self._robots.set_emergency_stop(robot, False)
        if robot is None:
            self._holds.update(False, ())  # though the robots may still say that they are stopped
        return None if stopped else nothing_released(request.snapshot)

    @property
    def pupils_release(self) -> bool:
        """Whether a pupil may release the stop of all robots."""
        return None in self._by_pupils

    def check(self, snapshot: Snapshot, before: Snapshot) -> None:
        """Forget the stops that are over, and those that another program has engaged as well. before: the last one."""
        self._holds.update(snapshot.emergency, snapshot.robots.keys() - before.robots.keys())
        self._by_pupils = set(filter(snapshot.is_stopped_here, self._by_pupils))


def nothing_released(snapshot: Snapshot) -> Notice:
    """Return that there was nothing to release, and which robots are stopped by their own emergency stops."""
    stopped = [robot.label for robot in snapshot.robots.values() if robot.stopped]
    return say("others_stopped", robots=", ".join(stopped)) if stopped else say("not_stopped")
