"""Who may drive which robot, and what it is given. No sockets, no ROS and no clock: times are monotonic seconds."""

import math
import threading
from typing import TYPE_CHECKING, Callable, Dict, List, Optional, Set

from jetbot.text import enumeration

from . import dead_man, protocol
from .client import TEACHER, Client
from .history import History
from .lease import Leases
from .protocol import notice
from .stops import Stops
from .view import Snapshot, label

if TYPE_CHECKING:  # they need ROS
    from .drive import Drive
    from .robots import Robots

LET_GO = "Let go, then drive again."
NO_COMMAND = f"No command for {dead_man.TIMEOUT} s. {LET_GO}"


class Control:
    """Does what the clients ask for; any thread may call it. drive: drives robots; robots: what they report.

    ``check`` reads what the robots report, once for all clients.
    """

    def __init__(self, robots: "Robots", drive: "Drive"):
        self._robots, self._drive = robots, drive
        self._snapshot = robots.snapshot()
        self._leases, self._stops, self._history = Leases(), Stops(), History(robots.forget_result)
        self._names: Dict[int, str] = {}
        self._must_lift: Set[int] = set()
        self._checked_at, self._stale_until = math.inf, -math.inf
        self._lock = threading.RLock()
        self._actions: Dict[type, Callable] = {
            protocol.Drive: self._on_drive, protocol.Take: self._on_take, protocol.Stop: self._on_stop,
            protocol.Release: self._on_release, protocol.Reset: self._on_reset, protocol.Name: self._on_name}

    def handle(self, client: Client, message: protocol.Message, now: float) -> Optional[dict]:
        """Do what a client asks for; return the answer to its page, a message of the socket, or None."""
        with self._lock:
            self._names.setdefault(client.id, client.name)
            self._note_interruption(now)
            return self._actions[type(message)](client, message, now)

    def leave(self, client: int) -> None:
        """The client's socket is closed: its robot stops at once, and is free."""
        with self._lock:
            self._free(self._leases.robot_of(client))
            self._names.pop(client, None)
            self._must_lift.discard(client)

    def check(self, now: float) -> List[dict]:
        """End the leases of silent clients and of robots that cannot be driven; call it 20 times a second.

        Return messages of the socket for all clients.
        """
        with self._lock:
            self._note_interruption(now)
            self._checked_at = now
            snapshot = self._snapshot = self._robots.snapshot()
            for robot in self._leases.robots():
                if snapshot.problem(robot) or self._leases.has_expired(robot, now):
                    self._free(robot)
            self._stops.update(snapshot)
            return self._history.update(snapshot.robots, now)

    def close(self) -> None:
        """Stop all robots that are driven from here."""
        with self._lock:
            self._drive.close()

    def snapshot(self) -> Snapshot:
        """Return the robots as of the last check."""
        return self._snapshot

    def robots(self) -> List[dict]:
        """Return the robots of the message "robots"."""
        return [robot.description() for robot in self._snapshot.robots.values()]

    def state(self) -> dict:
        """Return the message "state"."""
        with self._lock:
            snapshot = self._snapshot
            states = {robot.id: robot.state(self._driver(robot.id)) for robot in snapshot.robots.values()}
        return {"type": "state", "emergency": snapshot.emergency, "robots": states}

    def history(self) -> List[dict]:
        """Return the messages that a new page needs besides "robots" and "state"."""
        with self._lock:
            return self._history.messages()

    def _on_drive(self, client, message, now):
        robot, driving = message.robot, bool(message.forward or message.left)
        if not driving:
            return self._on_lifted(client, robot, now)
        refusal = self._refusal(client, robot, now)
        if not refusal:
            self._lease(client, robot, now, driving)
            velocity = self._snapshot.robots[robot].velocity(message.forward, message.left)
            refusal = "" if self._drive.command(robot, velocity, now) else NO_COMMAND
        if not refusal:
            return None
        self._must_lift.add(client.id)
        if self._leases.driver(robot) == client.id:
            self._drive.release(robot)
        return {"type": "lift", "robot": robot, "text": refusal}

    def _on_lifted(self, client, robot, now):
        self._must_lift.discard(client.id)
        if self._leases.driver(robot) == client.id:
            self._drive.release(robot)
            self._lease(client, robot, now, driving=False)

    def _note_interruption(self, now):
        """Drive nothing for a moment if this process was frozen: old commands waited in the sockets."""
        if now - self._checked_at >= dead_man.TIMEOUT:
            self._stale_until = now + dead_man.TIMEOUT

    def _refusal(self, client, robot, now) -> str:
        """Return why the client may not drive this robot now, or ""."""
        if not client.may_drive(robot):
            return f"With your code, you can drive only {label(client.robot)}."
        if now < self._stale_until:
            return f"The cockpit was interrupted. {LET_GO}"
        driver = self._leases.driver(robot)
        if driver not in (None, client.id):
            return f"{self._names[driver]} drives {label(robot)}."
        return self._snapshot.problem(robot) or (LET_GO if client.id in self._must_lift else "")

    def _on_take(self, client, message, now):
        robot = message.robot
        if client.role != TEACHER:
            return notice("Only a teacher can take a robot.")
        ended = self._snapshot.ended(robot)
        if ended:
            return notice(ended)
        if self._leases.driver(robot) != client.id:
            self._free(robot)
            self._lease(client, robot, now, driving=False)
        return None

    def _on_stop(self, client, message, now):
        robot = message.robot
        refusal = self._snapshot.ended(robot) or self._stops.stop(client, robot)
        if refusal:
            return notice(refusal)
        self._robots.stop(robot, True)
        self._snapshot = self._robots.snapshot()
        for each in self._leases.robots() if robot is None else [robot]:
            self._free(each)
        return None

    def _on_release(self, client, message, now):
        refusal = self._stops.release(client, message.robot)
        if refusal:
            return notice(refusal)
        self._robots.stop(message.robot, False)
        self._snapshot = self._robots.snapshot()
        return None

    def _on_reset(self, client, message, now):
        if client.role != TEACHER:
            return notice("Only a teacher can put robots back.")
        chosen = [robot for robot in self._snapshot.robots.values()
                  if robot.simulated and message.robot in (None, robot.id)]
        for robot in chosen:
            self._history.reset(robot.id, now)
        silent = [robot.label for robot in chosen if not self._robots.reset(robot.id)]
        if silent:
            return notice(f"{enumeration(silent)} {'has' if len(silent) == 1 else 'have'} not answered yet.")
        return None if chosen else notice("Only simulated robots can be put back.")

    def _on_name(self, client, message, now):
        self._names[client.id] = message.name.strip() or client.name

    def _lease(self, client, robot, now, driving):
        """Give a free robot to the client, or go on; its other robot stops, and is free."""
        other = self._leases.robot_of(client.id)
        if other not in (None, robot):
            self._free(other)
            self._must_lift.discard(client.id)
        self._leases.renew(robot, client.id, now, driving)

    def _free(self, robot):
        """Stop the robot and end its lease. Who drove it meanwhile must lift the finger before driving again."""
        lease = self._leases.end(robot)
        if lease:
            self._drive.release(robot)
            if lease.driving:
                self._must_lift.add(lease.client)

    def _driver(self, robot):
        driver = self._leases.driver(robot)
        return None if driver is None else {"id": driver, "name": self._names[driver]}
