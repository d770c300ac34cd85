"""Who may drive which robot, and what it is given. Times are monotonic seconds."""

import math
from functools import partial
from typing import Callable, Dict, List, Optional, Set

from jetbot.text import enumeration

from ..classroom.classroom import Classroom
from ..notices import Notice, say
from .collection import Collection
from .history import History, Scores
from .offered_tasks import OfferedTasks
from .protocol import Message, notice
from .rights import COMMAND_TIMEOUT, TEACHER, Client, Holds, Lease, StopRights, refuse_role
from .snapshot import Snapshot, label

NO_COMMAND = say("no_command", seconds=COMMAND_TIMEOUT)
TAKEN, LEFT = "a teacher took the robot over", "the driver's page was closed, or lost its connection"  # interruptions
SILENT = f"no command came from the driver's page for {COMMAND_TIMEOUT} s"


class Control:
    """Does what the clients ask for, in one thread.

    robots: what they report (robots.discovery.Robots), which ``check`` reads once for all clients;
    drivers: what commands them (robots.publishers.Drivers); cameras: what they see (robots.cameras.Cameras).
    """

    def __init__(self, robots, drivers, cameras, collection: Collection, classroom: Classroom):
        self._robots, self._drivers, self._cameras, self._collection = robots, drivers, cameras, collection
        self._kept = {}  # by the robot: the picture of it that was kept last
        self.snapshot: Snapshot = robots.snapshot()  # as of the last check
        self._leases: Dict[str, Lease] = {}  # by robot
        self._stop_rights, self._holds = StopRights(), Holds(drivers.keep_waiting)
        self._programs, self._classroom = classroom.programs, classroom
        self._history = History(Scores(classroom.read("scores", list), partial(classroom.keep, "scores")))
        self._tasks = OfferedTasks(classroom.read("tasks", list), partial(classroom.keep, "tasks"))
        self._names: Dict[int, str] = {}
        self._typed: Dict[int, str] = {}  # those of them that a person has typed
        self._must_lift: Set[int] = set()
        self._checked_at, self._stale_until = math.inf, -math.inf
        self._actions: Dict[str, Callable] = {
            "drive": self._on_drive, "program": self._on_program, "take": self._on_take, "stop": self._on_engage_stop,
            "release": self._on_release_stop, "go_on": self._on_go_on, "reset": self._on_reset, "name": self._on_name,
            "save": self._on_save, "delete": self._on_delete, "judge": self._on_judge, "offer": self._on_offer}

    def handle(self, client: Client, message: Message, now: float) -> Optional[dict]:
        """Do what a client asks for; return None, or a message of the socket that says why not."""
        self._names.setdefault(client.id, client.name)
        self._note_interruption(now)
        refusal = refuse_role(client, message.type) or self._actions[message.type](client, message, now)
        if refusal and message.type in ("drive", "program"):
            return {"type": "lift", "robot": message.robot, **refusal.fields()}
        if message.type == "program":
            ready = self._drivers.hold(message.robot)
            return {"type": "program", "robot": message.robot, "ready": ready, **self._robots.senses(message.robot)}
        return notice(refusal) if refusal else None

    def leave(self, client: int) -> None:
        """The client's socket is closed: its robot stops at once, and is free."""
        robot = self._robot_of(client)
        if robot and self._leases[robot].driving:
            self._report(robot, LEFT)
        elif robot:
            self._robots.judge(robot, "")
        self._free(robot)
        self._names.pop(client, None)
        self._typed.pop(client, None)
        self._must_lift.discard(client)

    def check(self, now: float) -> List[dict]:
        """End the leases of silent clients and of robots that cannot be driven; call it for each frame.

        Return messages of the socket for all clients.
        """
        self._note_interruption(now)
        self._checked_at = now
        before, self.snapshot = self.snapshot, self._robots.snapshot()
        for robot, lease in list(self._leases.items()):
            if lease.is_silent(now):
                self._report(robot, SILENT)
            if self.snapshot.problem(robot) or lease.has_expired(now):
                self._free(robot)
        self._holds.update(self.snapshot.emergency, self.snapshot.robots.keys() - before.robots.keys())
        self._stop_rights.update(self.snapshot.is_stopped_here)
        return self._history.update(self.snapshot.robots, now) + self._tasks.update(self._robots.tasks())

    @property
    def problem(self) -> Optional[Notice]:
        """Why the class is not kept now, for its teachers; or None."""
        return self._classroom.problem

    def robots(self) -> List[dict]:
        """Return the robots of the message "robots"."""
        return [robot.description() for robot in self.snapshot.robots.values()]

    def state(self) -> dict:
        """Return the message "state"."""
        states = {name: robot.message(self._describe_driver(name), self._seconds_until_programs(robot),
                                      self._holds[name], self._history.task(robot),
                                      self._drivers.stalls(name, self._checked_at), self._collection.state(name),
                                      self._programs.changed(name))
                  for name, robot in self.snapshot.robots.items()}
        return {"type": "state", "emergency": self.snapshot.emergency,
                "pupils_release": self._stop_rights.pupils_release, "robots": states}

    def history(self) -> List[dict]:
        """Return the messages that a new page needs besides "robots" and "state"."""
        return [*self._history.messages(), self._tasks.message()]

    # What a client asks for; each returns why that is refused, or None.

    def _on_drive(self, client, message, now):
        robot = message.robot
        if not (message.forward or message.left):
            return self._on_let_go(client, robot, now)
        refusal = self._refusal(client, robot, now)
        if not refusal:
            self._lease(client, robot, now, driving=True)
            velocity = self.snapshot.robots[robot].velocity(message.forward, message.left)
            refusal = None if self._drivers.drive(robot, velocity, now) else NO_COMMAND
        if refusal:
            self._must_lift.add(client.id)
            if self._driver(robot) == client.id:
                self._drivers.let_go(robot)
                if not self.snapshot.problem(robot):  # which the robot's status says
                    self._report(robot, SILENT)
        return refusal

    def _on_program(self, client, message, now):
        """A program runs: its robot stays its own while it stands. What drives is commands alone."""
        refusal = self._refusal(client, message.robot, now)
        driven = self._driver(message.robot) == client.id and self._leases[message.robot].driving
        if not refusal and not driven:
            self._lease(client, message.robot, now, driving=False)
        return refusal

    def _on_let_go(self, client, robot, now):
        self._must_lift.discard(client.id)
        if self._driver(robot) == client.id:
            self._drivers.let_go(robot)
            self._lease(client, robot, now, driving=False)
        return

    def _on_take(self, client, message, now):
        robot = message.robot
        if robot in self.snapshot.robots:
            if self._driver(robot) != client.id:
                self._report(robot, TAKEN)
                self._free(robot)
                self._lease(client, robot, now, driving=False)
            self._holds.take(robot)
        return self.snapshot.ended(robot)

    def _on_engage_stop(self, client, message, now):
        robot = message.robot
        refusal = self.snapshot.ended(robot) or self._stop_rights.engage(
            client, robot, self.snapshot.may_be_stopped(robot))
        if not refusal:
            self._robots.set_emergency_stop(robot, True)
            self.snapshot = self._robots.snapshot()  # ``check`` ends the leases
            if client.role == TEACHER:
                self._holds.stop(self.snapshot.robots if robot is None else [robot], robot is None)
        return refusal

    def _on_release_stop(self, client, message, now):
        refusal = self._stop_rights.release(client, message.robot)
        if not refusal:
            self._robots.set_emergency_stop(message.robot, False)
            self.snapshot = self._robots.snapshot()
            if message.robot is None:
                self._holds.update(False, ())  # though the robots may still say that they are stopped
        return refusal

    def _on_go_on(self, client, message, now):
        own = self._robot_of(client.id)
        self._holds.give_back(message.robot)
        if message.robot in (None, own):
            self._free(own)

    def _on_reset(self, client, message, now):
        chosen = [robot for robot in self.snapshot.robots.values()
                  if robot.simulated and message.robot in (None, robot.id)]
        for robot in chosen:
            self._history.reset(robot.id, now)
        silent = [robot.label for robot in chosen if not self._robots.reset(robot.id)]
        if silent:
            return say("not_reset", robots=enumeration(silent))
        return None if chosen else say("real_not_reset")

    def _on_name(self, client, message, now):
        self._typed[client.id] = message.name.strip()
        self._names[client.id] = self._typed[client.id] or client.name
        return

    def _on_save(self, client, message, now):
        robot, picture = message.robot, self._cameras.newest(message.robot, now)
        refusal = self._refuse_collecting(client, robot, now) or (None if picture else say("no_picture"))
        if not refusal and picture != self._kept.get(robot):
            refusal = self._collection.save(robot, message.label, picture.jpeg)
            self._kept[robot] = self._kept.get(robot) if refusal else picture
        return refusal

    def _on_delete(self, client, message, now):
        return self._refuse_collecting(client, message.robot, now) or self._collection.delete(message.robot)

    def _refuse_collecting(self, client, robot, now) -> Optional[Notice]:
        """Return why the client may not collect pictures of this robot, or None: who drives it may, and so keeps it."""
        if self._driver(robot) != client.id:
            return say("driver_collects", robot=label(robot))
        if not self._leases[robot].driving:
            self._lease(client, robot, now, driving=False)
        return None

    def _on_judge(self, client, message, now):
        robot = message.robot
        if not message.task:
            return self._end_judging(client, robot)
        refusal = self._refusal(client, robot, now) or self._tasks.refusal(client, message.task)
        if refusal or not self.snapshot.robots[robot].simulated:
            return refusal or say("real_not_judged")
        self._drivers.let_go(robot)
        self._lease(client, robot, now, driving=False)
        self._history.forget_task(self.snapshot.robots[robot])
        self._robots.judge(robot, message.task)
        return None

    def _end_judging(self, client, robot):
        if robot in self.snapshot.robots and client.may_drive(robot) and self._driver(robot) in (None, client.id):
            self._robots.judge(robot, "")
        return

    def _on_offer(self, client, message, now):
        self._tasks.switch(message.task, message.on)

    def _note_interruption(self, now):
        """Drive nothing for a moment if this process was frozen: old commands waited in the sockets."""
        if now - self._checked_at >= COMMAND_TIMEOUT:
            self._stale_until = now + COMMAND_TIMEOUT

    def _refusal(self, client, robot, now) -> Optional[Notice]:
        """Return why the client may not drive this robot now, or None."""
        if not client.may_drive(robot):
            return say("own_robot_only", robot=label(client.robot))
        if now < self._stale_until:
            return say("interrupted")
        refusal, driver = self._holds.refusal(client, robot), self._driver(robot)
        if refusal:
            return refusal
        if driver not in (None, client.id):
            return say("driven", driver=self._names[driver], robot=label(robot))
        return self.snapshot.problem(robot) or (say("let_go") if client.id in self._must_lift else None)

    def _lease(self, client, robot, now, driving):
        """Give a free robot to the client, or go on; its other robot stops, and is free."""
        other = self._robot_of(client.id)
        if other not in (None, robot):
            self._free(other)
            self._must_lift.discard(client.id)
        self._leases[robot] = Lease(client.id, now, driving)
        self._report(robot)

    def _report(self, robot, interruption=""):
        """Tell the robot's judge who drives it, by the name that this person has typed, and what interrupted that."""
        self._robots.report_driver(robot, self._typed.get(self._driver(robot), ""), interruption)

    def _free(self, robot):
        """Stop the robot and end its lease. Who drove it meanwhile must lift the finger before driving again."""
        lease = self._leases.pop(robot, None)
        if lease:
            self._drivers.let_go(robot)
            if lease.driving:
                self._must_lift.add(lease.client)

    def _driver(self, robot) -> Optional[int]:
        return self._leases[robot].client if robot in self._leases else None

    def _describe_driver(self, robot) -> Optional[dict]:
        driver = self._driver(robot)
        return None if driver is None else {"id": driver, "name": self._names[driver]}

    def _seconds_until_programs(self, robot) -> Optional[int]:
        """Return when programs that wait drive on, or None if none do, or not by themselves."""
        left = self._drivers.resumes_in(robot.id, self._checked_at)
        return math.ceil(left) if robot.programs_wait and not self._holds[robot.id] and left > 0 else None

    def _robot_of(self, client: int) -> Optional[str]:
        return next((robot for robot, lease in self._leases.items() if lease.client == client), None)
