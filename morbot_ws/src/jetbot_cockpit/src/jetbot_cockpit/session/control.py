"""What the clients ask for goes to who does it; what the robots report comes back as messages of the socket."""

import math
from functools import partial
from typing import Callable, Dict, List, Optional

from jetbot_ros.state import MANUAL_PRIORITY

from ..classroom.classroom import Classroom
from ..notices import Notice
from .camera_switch import CameraSwitch
from .collecting import Collecting
from .collection import Collection
from .holds import Holds
from .judging import Judging
from .leases import Leases
from .protocol import Message, notice
from .pupils import Pupils
from .rights import Client, Request, refuse_role
from .snapshot import RobotSnapshot, Snapshot
from .stops import Stops

QUIET = 0.5  # s without a command until the countdown begins: a program that is paused in a page repeats its zeros


class Control:
    """Does what the clients ask for, in one thread.

    robots: what they report (robots.discovery.Robots), which ``check`` reads once for all clients; drivers: what
    commands them (robots.command_publishers.Drivers); cameras: what they see (robots.camera_topics.Cameras);
    version: what runs on this computer.
    """

    def __init__(self, robots, drivers, cameras, collection: Collection, classroom: Classroom,
                 version: str = ""):
        self._version = version
        self._robots, self._drivers, self._collection, self._classroom = robots, drivers, collection, classroom
        self.snapshot: Snapshot = robots.snapshot()  # as of the last check, or stop
        self._holds = Holds(drivers)
        self._pupils = pupils = Pupils(classroom.read("names", dict), partial(classroom.keep, "names"))
        self._stops, self._leases = Stops(robots, self._holds), Leases(robots, drivers, self._holds, pupils)
        self._judging = Judging(robots, self._leases, classroom)
        self._camera_switch = switch = CameraSwitch(classroom.read("cameras", dict), partial(classroom.keep, "cameras"))
        leases, judging = self._leases, self._judging
        collecting = Collecting(cameras, collection, leases, switch.refusal)
        self._actions: Dict[str, Callable[[Request], Optional[Notice]]] = {
            "drive": leases.drive, "program": leases.program, "take": leases.take, "go_on": leases.go_on,
            "name": pupils.rename, "pupil": pupils.name, "release": self._stops.release, "judge": judging.judge,
            "offer": judging.offer, "cameras": switch.switch, "reset": judging.reset, "save": collecting.save,
            "delete": collecting.delete}

    def stop(self, client: Client, robot: Optional[str]) -> Optional[dict]:
        """Engage the emergency stop of a robot, or of all; return None, or a message that says why not."""
        refusal = self._stops.engage(client, robot, self.snapshot)
        self.snapshot = self._robots.snapshot()  # ``check`` ends the leases
        return notice(refusal) if refusal else None

    def handle(self, client: Client, message: Message, now: float) -> Optional[dict]:
        """Do what else a client asks for; return None, or a message of the socket that says why not."""
        request = Request(client, message, self.snapshot, now)
        refusal = refuse_role(client, message.type) or self._actions[message.type](request)
        if message.type == "release":
            self.snapshot = self._robots.snapshot()
        if refusal and message.type in ("drive", "program"):
            return {"type": "lift", "robot": message.robot, **refusal.fields()}
        if message.type == "judge":
            return self._judging.answer(message.robot, refusal)
        if message.type == "program":
            ready = self._drivers.hold(message.robot)
            return {"type": "program", "robot": message.robot, "ready": ready, **self._robots.senses(message.robot)}
        return notice(refusal) if refusal else None

    def leave(self, client: int) -> None:
        """The client's socket is closed: its robot stops at once, and is free."""
        self._leases.leave(client)
        self._pupils.leave(client)

    def check(self, now: float) -> List[dict]:
        """Let all look at the robots as they are now; call it for each frame.

        Return messages of the socket for all clients.
        """
        before, self.snapshot = self.snapshot, self._robots.snapshot()
        lifts = self._leases.check(self.snapshot, now)
        self._stops.check(self.snapshot, before)
        return lifts + self._judging.check(self.snapshot, now) + self._camera_switch.update()

    @property
    def problem(self) -> Optional[Notice]:
        """Why the class is not kept now, for its teachers; or None."""
        return self._classroom.problem

    def robots(self) -> List[dict]:
        """Return the robots of the message "robots"."""
        return [{**robot.description(), "pupil": self._pupils[robot.id], "version": self._version}
                for robot in self.snapshot.robots.values()]

    def state(self) -> dict:
        """Return the message "state"."""
        states = {name: robot.message(self._leases.driver(name), self._seconds_until_programs(robot),
                                      self._holds[name], self._judging.task(robot), self._leases.stalls(name),
                                      self._collection.state(name), self._classroom.programs.changed(name))
                  for name, robot in self.snapshot.robots.items()}
        return {"type": "state", "emergency": self.snapshot.emergency,
                "pupils_release": self._stops.pupils_release,
                "unconfirmed": self.snapshot.unconfirmed(), "robots": states}

    def history(self) -> List[dict]:
        """Return the messages that a new page needs besides "robots" and "state"."""
        return [*self._judging.messages(), self._camera_switch.message()]

    def readings(self, robot: str, since: Optional[int], eyes: bool) -> Optional[tuple]:
        """Return what a robot has reported, as robots.discovery.Robots.readings."""
        return self._robots.readings(robot, since, eyes)

    def camera_refusal(self, client: Client) -> Optional[Notice]:
        """Return why this person does not see what a camera sees, or None."""
        return self._camera_switch.refusal(client)

    def _seconds_until_programs(self, robot: RobotSnapshot) -> Optional[int]:
        """Return when programs that wait drive on, or None if none do, or not by themselves."""
        left = self._drivers.resumes_in(robot.id, self._leases.checked_at)
        counts = robot.programs_wait and not self._holds[robot.id] and 0 < left <= MANUAL_PRIORITY - QUIET
        return math.ceil(left) if counts else None
