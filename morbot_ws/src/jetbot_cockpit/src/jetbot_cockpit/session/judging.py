"""The driving tasks: who drives which one for a judge, and what is kept of that and of the map."""

from functools import partial
from typing import List, Optional

from jetbot.text import enumeration

from ..classroom.classroom import Classroom
from ..notices import Notice, say
from .history import History, Scores
from .leases import Leases
from .offered_tasks import OfferedTasks
from .rights import Request
from .snapshot import RobotSnapshot, Snapshot, TaskSnapshot


class Judging:
    """robots: what asks the judge and the simulators (robots.discovery.Robots); classroom: keeps tasks and scores."""

    def __init__(self, robots, leases: Leases, classroom: Classroom):
        self._robots, self._leases = robots, leases
        self._history = History(Scores(classroom.read("scores", list), partial(classroom.keep, "scores")))
        self._tasks = OfferedTasks(classroom.read("tasks", list), partial(classroom.keep, "tasks"))

    # What a client asks for; each returns why that is refused, or None.

    def judge(self, request: Request) -> Optional[Notice]:
        """Let a simulated robot drive a task; "" ends that."""
        client, robot, task, snapshot = request.client, request.robot, request.message.task, request.snapshot
        if not task:
            if robot in snapshot.robots and client.may_drive(robot) and not self._leases.has_other(client, robot):
                self.end(robot)
            return None
        refusal = self._leases.refusal(request) or self._tasks.refusal(client, task)
        if refusal or not snapshot.robots[robot].simulated:
            return refusal or say("real_not_judged")
        self._leases.halt(request)
        self._history.forget_task(snapshot.robots[robot])
        self._robots.judge(robot, task)
        return None

    def offer(self, request: Request) -> None:
        """Let pupils choose a task, or not."""
        self._tasks.switch(request.message.task, request.message.on)

    def reset(self, request: Request) -> Optional[Notice]:
        """Put simulated robots back to their starts, and end what drives them from pages, and their tasks."""
        chosen = [robot for robot in request.snapshot.robots.values()
                  if robot.simulated and request.robot in (None, robot.id)]
        for robot in chosen:
            self._leases.reset(robot.id, request.now)
            self.end(robot.id)
            self._history.reset(robot.id, request.now)
        silent = [robot.label for robot in chosen if not self._robots.reset(robot.id)]
        if silent:
            return say("not_reset", robots=enumeration(silent))
        return None if chosen else say("real_not_reset")

    # What the pages show

    def end(self, robot: str) -> None:
        """End the task of a robot, without a score."""
        self._robots.judge(robot, "")

    def task(self, robot: RobotSnapshot) -> Optional[TaskSnapshot]:
        """Return the task of the robot that is shown."""
        return self._history.task(robot)

    def check(self, snapshot: Snapshot, now: float) -> List[dict]:
        """Return messages of the socket with what has changed."""
        return self._history.update(snapshot.robots, now) + self._tasks.update(self._robots.tasks())

    def messages(self) -> List[dict]:
        """Return messages with all that a new page needs."""
        return [*self._history.messages(), self._tasks.message()]
