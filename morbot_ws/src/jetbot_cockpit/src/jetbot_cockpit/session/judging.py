"""The driving tasks: who drives which one for a judge, and what is kept of that and of the map."""

import secrets
from functools import partial
from typing import Dict, List, NamedTuple, Optional

from ..classroom.classroom import Classroom
from ..notices import Notice, say
from .history import History, Scores
from .leases import Leases
from .offered_tasks import OfferedTasks
from .rights import Client, Request
from .snapshot import RobotSnapshot, Snapshot, TaskSnapshot

AGAIN = {"driven": "judge_driven", "interrupted": "judge_interrupted"}  # how Judge me words why nobody may drive


class Asked(NamedTuple):
    """Who has asked for a robot to be judged. request: a word for it, which is new each time."""

    client: Client
    request: str


class Judging:
    """robots: what asks the judge and the simulators (robots.discovery.Robots); classroom: keeps tasks and scores."""

    def __init__(self, robots, leases: Leases, classroom: Classroom):
        self._robots, self._leases = robots, leases
        self._history = History(Scores(classroom.read("scores", list), partial(classroom.keep, "scores")))
        self._asked: Dict[str, Asked] = {}  # by robot
        self._tasks = OfferedTasks(classroom.read("tasks", list), partial(classroom.keep, "tasks"))

    # What a client asks for; each returns why that is refused, or None.

    def judge(self, request: Request) -> Optional[Notice]:
        """Let a simulated robot drive a task; "" ends what the client has asked for."""
        client, robot, task = request.client, request.robot, request.message.task
        if not task:
            if robot in self._asked and self._asked[robot].client == client:
                self.end(robot)
            return None
        refusal = self._refusal(request)
        if not refusal:
            self._leases.seize(request)
            self._history.forget_task(request.snapshot.robots[robot])
            self._asked[robot] = Asked(client, secrets.token_hex(4))
            self._robots.judge(robot, task, self._asked[robot].request)
        return refusal

    def _refusal(self, request):
        refusal = self._leases.refusal(request) or self._tasks.refusal(request.client, request.message.task)
        if refusal:
            return say(AGAIN.get(refusal.code, refusal.code), **refusal.arguments)
        robot = request.snapshot.robots[request.robot]
        if not robot.simulated:
            return say("real_not_judged")
        return say("judged_elsewhere", robot=robot.label) if robot.judged_elsewhere else None

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
            return say("not_reset", robots=", ".join(silent))
        return None if chosen else say("real_not_reset")

    # What the pages show

    def answer(self, robot: str, refusal: Optional[Notice]) -> dict:
        """Return the message "judge"."""
        request = self._asked[robot].request if robot in self._asked and not refusal else ""
        return {"type": "judge", "robot": robot, "request": request, "refusal": refusal and refusal.fields()}

    def end(self, robot: str) -> None:
        """End the task of a robot that was asked for here, without a score."""
        if self._asked.pop(robot, None):
            self._robots.judge(robot, "")

    def task(self, robot: RobotSnapshot) -> Optional[TaskSnapshot]:
        """Return the task of the robot that is shown."""
        return self._history.task(robot)

    def check(self, snapshot: Snapshot, now: float) -> List[dict]:
        """Return messages of the socket with what has changed."""
        for robot, (client, _) in list(self._asked.items()):
            if not self._leases.is_driver(client, robot):  # somebody else would be judged
                self.end(robot)
        return self._history.update(snapshot.robots, now) + self._tasks.update(self._robots.tasks())

    def messages(self) -> List[dict]:
        """Return messages with all that a new page needs."""
        return [*self._history.messages(), self._tasks.message()]
