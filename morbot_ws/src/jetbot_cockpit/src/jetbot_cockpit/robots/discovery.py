"""Which robots there are, by the ROS master, and what they report."""

import re
import threading
import time
from typing import Dict, Iterable, Optional, Set, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticArray

from jetbot.sentence import Sentence
from jetbot_ros import contract
from jetbot_ros.links import Links
from jetbot_ros.master import NO_ANSWER
from jetbot_ros.state import EMERGENCY_STOP

from ..cockpit_parameters import MAX_ROBOTS
from ..session.snapshot import Snapshot
from .judge_topics import Judge
from .map_topics import Frames
from .recording import Readings
from .robot_topics import RobotTopics, StopTopic

POLL_INTERVAL = 1.0   # s between two questions to the master
MASTER_TIMEOUT = 4.0  # s without an answer until the master counts as gone
STATE = re.compile(rf"(?=.{{1,100}}$)((?:/[A-Za-z]\w*)*)/{contract.STATE}", re.ASCII)


class Robots:
    """All robots on the master. No method blocks: a thread of its own asks the master. Needs an initialized node."""

    def __init__(self):
        self._robots: Dict[str, RobotTopics] = {}  # replaced, never changed
        self._frames = Frames()
        self._links = Links()
        self._emergency_stop, self._judge = StopTopic(contract.STOP, self._graph), Judge()
        self._answered_at = time.monotonic()
        rospy.Subscriber("/diagnostics", DiagnosticArray, self._on_diagnostics)
        threading.Thread(target=self._run, daemon=True).start()

    def snapshot(self) -> Snapshot:
        """Return what is known now."""
        now, robots = time.monotonic(), self._robots
        answered = now - self._answered_at < MASTER_TIMEOUT
        views = {name: robot.snapshot(now, answered) for name, robot in robots.items()}
        held = any(views[name].answers and robot.is_held_by(EMERGENCY_STOP) for name, robot in robots.items())
        stops = {None: self._emergency_stop, **{name: robot.emergency_stop for name, robot in robots.items()}}
        elsewhere = frozenset(name for name, stop in stops.items() if stop.by_others)
        return Snapshot(views, answered, self._emergency_stop.engaged or held, elsewhere)

    def set_emergency_stop(self, robot: Optional[str], engaged: bool) -> None:
        """Engage or release the emergency stop of all robots (None), or of one."""
        if robot is None:
            self._emergency_stop.set(engaged)
        elif robot in self._robots:
            self._robots[robot].emergency_stop.set(engaged)

    def senses(self, robot: str) -> dict:
        """Return what a program may read of the robot now; docs/protocol.md explains it."""
        return self._robots[robot].senses(time.monotonic()) if robot in self._robots else {}

    def readings(self, robot: str, since: Optional[int], eyes: bool) -> Optional[Tuple[float, Readings]]:
        """Return the time now (s since the epoch), and what a robot has reported after the row with this number, None:
        no row yet; None for a robot that is gone. For as long as it is called, its battery is followed, and its line
        sensor if ``eyes``.
        """
        topics = self._robots.get(robot)
        return (rospy.get_time(), topics.readings(since, eyes)) if topics else None

    def tasks(self) -> Tuple[Tuple[str, str], ...]:
        """Return (name, title) of each task that a judge offers now."""
        return self._judge.tasks()

    def judge(self, robot: str, task: str, request: str = "") -> None:
        """Ask the judge to put a robot at the start of a task, and to judge its next drive; task "" ends that.

        request: a word that the robot's task has from then on.
        """
        self._judge.request(robot, task, request)

    def report_driver(self, robot: str, name: str, interruption: Optional[Sentence]) -> None:
        """Publish who drives a robot, "" for nobody or no name, and what has interrupted that, or None."""
        if robot in self._robots:
            self._robots[robot].report_driver(name, interruption)

    def reset(self, robot: str) -> bool:
        """Put a simulated robot back to its start; return False if it has not answered the last time yet."""
        return robot in self._robots and self._robots[robot].reset()

    def _graph(self):
        return self._links.graph

    def _run(self):
        while not rospy.is_shutdown():
            try:
                self._links.heal()
                self._answered_at = time.monotonic()
                publishers, _, services = self._links.graph
                self._update(publishers, services)
            except NO_ANSWER:
                pass  # snapshot reports it
            time.sleep(POLL_INTERVAL)

    def _update(self, publishers, services):
        """Subscribe to the robots that have appeared, and drop those that have ended, but for those stopped here."""
        found = sorted(names_of(publishers))[:MAX_ROBOTS]
        robots = {name: robot for name, robot in self._robots.items()
                  if name in found or robot.connected or robot.emergency_stop.latched}
        ended = [robot for name, robot in self._robots.items() if name not in robots]
        for name in found:
            robots[name] = robots.get(name) or RobotTopics(name, self._frames, self._graph)
        for name, robot in robots.items():
            robot.follow_asked()
            robot.simulated = f"{name.rstrip('/')}/{contract.RESET}" in services
        self._robots = dict(sorted(robots.items()))
        for robot in ended:
            robot.close()

    def _on_diagnostics(self, message):
        name = message._connection_header.get("callerid", "")
        robot_name, _, node = name.rpartition("/")
        robot = self._robots.get(robot_name or "/") if node == contract.CONTROLLER else None
        for status in message.status:
            if robot and status.name == f"{name[1:]}: motors":
                robot.diagnose(status)
            if robot and status.name == f"{name[1:]}: health":
                robot.diagnose_health(status)


def names_of(topics: Iterable[str]) -> Set[str]:
    """Return the namespaces in which a jetbot_controller's state is among these topics."""
    return {match[1] or "/" for match in filter(None, map(STATE.fullmatch, topics))}
