"""Who drives which robot. Times are monotonic seconds."""

import math
from typing import Dict, List, Optional, Set

from jetbot.sentence import row
from jetbot_ros.contract import INTERRUPTIONS

from ..notices import Notice, say
from .history import RESET_TIME
from .holds import Holds
from .lease import COMMAND_TIMEOUT, Lease
from .pupils import Pupils
from .rights import Client, Request
from .snapshot import Snapshot, label

MINUTE = 60.0  # s, in which stalls are counted
NO_COMMAND, LET_GO = say("no_command", seconds=COMMAND_TIMEOUT), say("let_go")
TAKEN, LEFT, PUT_BACK = (row(INTERRUPTIONS, code) for code in ("taken", "left", "put_back"))
SILENT = row(INTERRUPTIONS, "silent", seconds=COMMAND_TIMEOUT)


class Leases:
    """All leases. robots: what reports the drivers; drivers: what commands the robots; holds: what teachers have taken.

    pupils: what people are called; checked_at: the time of the last ``check``.
    """

    def __init__(self, robots, drivers, holds: Holds, pupils: Pupils):
        self._robots, self._drivers, self._holds, self._pupils = robots, drivers, holds, pupils
        self._leases: Dict[str, Lease] = {}  # by robot
        self._must_lift: Dict[int, Notice] = {}  # why the finger must lift, by client
        self._stalls: Dict[str, Set[float]] = {}  # the times of the commands that none followed, by robot
        self._reset_until: Dict[str, float] = {}  # by robot
        self._lifts: List[dict] = []  # messages for all pages, not sent yet
        self.checked_at, self._stale_until = math.inf, -math.inf

    # What a client asks for; each returns why that is refused, or None.

    def drive(self, request: Request) -> Optional[Notice]:
        """Drive a robot, or let it go."""
        client, message, snapshot, now = request
        if not message.moves:
            self._must_lift.pop(client.id, None)
            if self.is_driver(client, request.robot):
                self.halt(request)
            return None
        refusal = self.refusal(request)
        if refusal:
            self._interrupt(request)
            return refusal
        lease = self._give(request, driving=True)
        velocity = snapshot.robots[request.robot].velocity(message.forward, message.left)
        self._drivers.drive(request.robot, velocity, lease)
        return None

    def program(self, request: Request) -> Optional[Notice]:
        """A program runs: its robot stays its own while it stands. What drives is commands alone."""
        refusal = self.refusal(request)
        if not refusal:
            self.keep(request)
        return refusal

    def take(self, request: Request) -> Optional[Notice]:
        """Take a robot from its driver, until ``go_on``."""
        client, robot = request.client, request.robot
        if robot in request.snapshot.robots:
            if not self.is_driver(client, robot):
                self._report(robot, TAKEN)
                self._free(robot)
                self._give(request, driving=False)
            self._holds.take(robot)
        return request.snapshot.ended(robot)

    def reset(self, robot: str, now: float) -> None:
        """The robot is put back to its start: end what drives it here, and let nobody drive it on the way."""
        reason = say("put_back", robot=label(robot))
        lease = self._leases.get(robot)
        if lease:
            self._report(robot, PUT_BACK)
            self._free(robot)
            if lease.driving:
                self._must_lift[lease.client.id] = reason
        self._reset_until[robot] = now + RESET_TIME
        self._lifts.append({"type": "lift", "robot": robot, **reason.fields()})

    def go_on(self, request: Request) -> None:
        """Give back a robot that teachers hold, or all; the own one is free."""
        own = self._robot_of(request.client.id)
        self._holds.give_back(request.robot)
        if request.robot in (None, own):
            self._free(own)

    # What else has a driver

    def refusal(self, request: Request) -> Optional[Notice]:
        """Return why the client may not drive this robot now, or None."""
        client, robot = request.client, request.robot
        if not client.may_drive(robot):
            return say("own_robot_only", robot=label(client.robot))
        if self._is_stale(request.now):
            return say("interrupted")
        self._notice_silence(robot, request.now)
        if request.now < self._reset_until.get(robot, -math.inf):
            return say("put_back", robot=label(robot))
        if self._holds.is_taken_from(client, robot):
            return say("taken", robot=label(robot))
        if self.has_other(client, robot):
            return say("driven", driver=self._name(self._leases[robot]), robot=label(robot))
        return request.snapshot.problem(robot) or self._must_lift.get(client.id)

    def is_driver(self, client: Client, robot: Optional[str]) -> bool:
        """Return whether this robot is the client's."""
        return robot in self._leases and self._leases[robot].client.id == client.id

    def has_other(self, client: Client, robot: str) -> bool:
        """Return whether this robot is somebody else's."""
        return robot in self._leases and not self.is_driver(client, robot)

    def halt(self, request: Request) -> None:
        """Stop the robot, which is the client's from now on."""
        self._drivers.let_go(request.robot)
        self._give(request, driving=False)

    def seize(self, request: Request) -> None:
        """Stop the robot, which is the client's from now on, also if a program commands it: that waits."""
        self.halt(request)
        self._drivers.hold(request.robot)

    def keep(self, request: Request) -> None:
        """Keep a robot that is free or the client's for LEASE_TIMEOUT; while it is driven, only commands do that."""
        if not (self.is_driver(request.client, request.robot) and self._leases[request.robot].driving):
            self._give(request, driving=False)

    def leave(self, client: int) -> None:
        """The client's socket is closed: its robot stops at once, and is free."""
        robot = self._robot_of(client)
        if robot is not None and self._leases[robot].driving:
            self._report(robot, LEFT)
        self._free(robot)
        self._must_lift.pop(client, None)

    def check(self, snapshot: Snapshot, now: float) -> List[dict]:
        """End the leases of silent clients and of robots that cannot be driven; return messages for all pages."""
        self._is_stale(now)
        self.checked_at = now
        for robot, lease in list(self._leases.items()):
            self._notice_silence(robot, now)
            if snapshot.problem(robot) or lease.has_expired(now):
                self._free(robot)
        lifts, self._lifts = self._lifts, []
        return lifts

    def driver(self, robot: str) -> Optional[dict]:
        """Return who drives the robot, for the message "state"."""
        lease = self._leases.get(robot)
        if not lease:
            return None
        name = self._name(lease)
        return {"id": lease.client.id, "name": str(name), "said": None if isinstance(name, str) else name.fields()}

    def stalls(self, robot: str) -> int:
        """Return how often the switch has fired within the last minute."""
        recent = {each for each in self._stalls.get(robot, ()) if self.checked_at - each < MINUTE}
        self._stalls[robot] = recent
        return len(recent)

    def _is_stale(self, now):
        """Return whether commands are too old: this process was frozen, and they waited in the sockets meanwhile."""
        if now - self.checked_at >= COMMAND_TIMEOUT:
            self._stale_until = now + COMMAND_TIMEOUT
        return now < self._stale_until

    def _notice_silence(self, robot, now):
        """If the switch has fired, the finger must lift. The thread that publishes has stopped the robot."""
        lease = self._leases.get(robot)
        if lease and lease.is_silent(now):
            self._stalls.setdefault(robot, set()).add(lease.commanded_at)
            self._must_lift.setdefault(lease.client.id, NO_COMMAND)
            self._report(robot, SILENT)

    def _interrupt(self, request):
        """A command is refused: the finger must lift, and the robot that it drove stops."""
        self._must_lift.setdefault(request.client.id, LET_GO)
        if self.is_driver(request.client, request.robot):
            self._drivers.let_go(request.robot)
            if not request.snapshot.problem(request.robot):  # which the robot's status says
                self._report(request.robot, SILENT)

    def _give(self, request, driving) -> Lease:
        """Give a free robot to the client, or renew its lease; its other robot stops, and is free."""
        client, robot = request.client, request.robot
        other = self._robot_of(client.id)
        if other not in (None, robot):
            self._free(other)
            self._must_lift.pop(client.id, None)
        self._leases[robot] = Lease(client, request.now, driving)
        self._report(robot)
        return self._leases[robot]

    def _report(self, robot, interruption=None):
        """Tell the robot's judge who drives it, by name, and what interrupted that."""
        name = self._pupils.called(self._leases[robot].client) if robot in self._leases else ""
        self._robots.report_driver(robot, name, interruption)

    def _free(self, robot):
        """Stop the robot and end its lease. Who drove it meanwhile must lift the finger before driving again."""
        lease = self._leases.pop(robot, None)
        if lease:
            self._drivers.let_go(robot)
            if lease.driving:
                self._must_lift.setdefault(lease.client.id, LET_GO)

    def _name(self, lease):
        return self._pupils.called(lease.client) or lease.client.name

    def _robot_of(self, client: int) -> Optional[str]:
        return next((robot for robot, lease in self._leases.items() if lease.client.id == client), None)
