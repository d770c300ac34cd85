"""A simulated robot as the judge sees it: where it truly is, what holds it, and what is around it. Moves no wheel."""

import contextlib
import functools
import re
from collections import deque
from threading import Thread
from typing import Iterator, List, Optional, Sequence, Tuple

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from nav_msgs.msg import Odometry
from std_msgs.msg import String
from std_srvs.srv import Empty
from visualization_msgs.msg import MarkerArray

from jetbot import InvalidValue
from jetbot.sentence import Sentence
from jetbot.text import enumeration, printable
from jetbot_ros import contract
from jetbot_ros.master import NO_ANSWER, condition_of, system_state
from jetbot_ros.state import EMERGENCY_STOP, ENDED, HOLDS, OWN_EMERGENCY_STOP, UNKNOWN, read

from ..report.marks import changed
from ..scoring.recorder import Sample
from ..scoring.sentences import not_counted, say
from .bags import sample_of
from .readers import Readers

SIMULATOR = re.compile(rf"((?:/[A-Za-z]\w*)*)/{contract.RESET}", re.ASCII)
STOPPED_AFTER = 0.5   # s without motion
MOTION = 1e-4         # m or rad; less is none
SILENT_POLLS = 60     # polls without ground truth, which arrives 10 times per second, until the simulator is silent
MAX_MESSAGE = 200     # characters of what interrupts a drive
RELEASE = "Release it: ./morbot stop --release"


def choose_robots(names: Sequence[str], running: Sequence[str]) -> List[str]:
    """Return the namespaces of the robots of these names, or of the only one: "", or "/red"; else raise InvalidValue.

    running: the namespaces of all simulated robots.
    """
    robots = {label(namespace): namespace for namespace in running}
    if not robots:
        raise InvalidValue("there is no simulated robot",
                           "Start one in another terminal: roslaunch simulation simulation.launch")
    if not names and len(robots) > 1:
        raise InvalidValue(f"there are {len(robots)} simulated robots: {enumeration(list(robots))}",
                           f"Name one: --robot {list(robots)[0]}")
    for name in names:
        if label(name) not in robots:
            raise InvalidValue(f"there is no simulated robot {name}", f"The robots are: {enumeration(list(robots))}")
    return list(dict.fromkeys(robots[label(name)] for name in names)) or list(running)


def simulated_robots() -> List[str]:
    """Return the namespaces of all simulated robots that run on the master; raise NO_ANSWER."""
    services = {SIMULATOR.fullmatch(name): nodes for name, nodes in system_state()[2].items()}
    alive = functools.lru_cache()(condition_of)  # one node has all robots of a class
    return sorted(match[1] for match, nodes in services.items() if match and any(map(alive, nodes)))


def label(namespace: str) -> str:
    """Return what a robot is called: its namespace without the first slash, and a robot without one, "robot"."""
    return namespace.strip("/") or "robot"


class JudgedRobot:
    """``poll`` reads what has arrived; the rest returns what is known by then. Needs an initialized node.

    by_camera: whether a program must look at the camera, and none may read where the robot is, or its line sensor.
    """

    def __init__(self, namespace: str, by_camera: bool = False):
        self.namespace, self.name = namespace, label(namespace)
        self.samples: List[Sample] = []  # what the last poll has read: the newest ground truth, oldest first
        self.latest: Optional[Sample] = None  # of all
        self.set_back = 0.0  # s by which its computer's clock was set back; the times of samples go on all the same
        self.driver, self.interruptions = "", []  # the name of who drives by a page; what the last poll has read
        self._arrived, self._silent_polls, self._moved_at, self._time = deque(), 0, 0.0, 0.0
        self._interruptions, self._commander, self._has_cockpit = deque(), "", False
        self._readers = Readers(namespace) if by_camera else None
        self._state, self._worlds, self._known_worlds = UNKNOWN, 0, 0
        self.body = "an unknown body"  # until the simulator has said how it differs
        self.truth_topic = f"{namespace}/{contract.GROUND_TRUTH}"
        self.body_topic = f"{namespace}/{contract.BODY}"
        self._world = rospy.Publisher(f"{namespace}/{contract.SET_WORLD}", String, queue_size=1, latch=True)
        self._reset = rospy.ServiceProxy(f"{namespace}/{contract.RESET}", Empty)
        self._controller = rospy.Subscriber(f"{namespace}/{contract.STATE}", DiagnosticStatus, self._on_state)
        rospy.Subscriber(f"{namespace}/{contract.WORLD}", MarkerArray, self._on_world)
        self._pages = rospy.Subscriber(f"{namespace}/{contract.DRIVER}", DiagnosticStatus, self._on_driver)
        rospy.Subscriber(self.body_topic, String, self._on_body)
        rospy.Subscriber(self.truth_topic, Odometry, self._arrived.append)

    def _on_state(self, message):
        self._state = read(message)
        self._commander = self._state.commanded_by or self._commander

    def _on_driver(self, message):
        values = {pair.key: printable(pair.value)[:MAX_MESSAGE] for pair in message.values}
        self.driver = values.get("name", "")[:contract.MAX_NAME]
        if message.message:
            self._interruptions.append(not_counted(values, printable(message.message)[:MAX_MESSAGE]))

    def _on_body(self, message):
        self.body = message.data

    def _on_world(self, _):
        self._worlds += 1

    def poll(self) -> None:
        """Read what has arrived; call it every POLL_INTERVAL."""
        self._notice_cockpit()
        self.interruptions = [self._interruptions.popleft() for _ in range(len(self._interruptions))]
        self.samples = [self._continued(sample_of(self._arrived.popleft())) for _ in range(len(self._arrived))]
        self._silent_polls = 0 if self.samples else self._silent_polls + 1
        for sample in self.samples:
            if not self.latest or any(abs(new - old) > MOTION for new, old in zip(sample.pose, self.latest.pose)):
                self._moved_at = sample.time
            self.latest = sample
        if self._readers:
            self._readers.poll(not self.has_stopped)

    def _notice_cockpit(self):
        """If the cockpit that drives the robot has ended, it could not say so itself."""
        had_cockpit, self._has_cockpit = self._has_cockpit, self._pages.get_num_connections() > 0
        if had_cockpit and not self._has_cockpit and self._commander.rpartition("/")[2] == contract.COCKPIT:
            self._interruptions.append(say("not_counted_cockpit_ended"))

    def _continued(self, sample):
        """Return the sample with a time that is not before the last one: where its clock is set back, it steps on."""
        self._time = max(self._time, sample.time + self.set_back)
        self.set_back = max(self.set_back, self._time - sample.time)
        return sample._replace(time=self._time)

    @property
    def has_stopped(self) -> bool:
        """Whether the robot has not moved for STOPPED_AFTER seconds."""
        return self.latest is not None and self.latest.time - self._moved_at >= STOPPED_AFTER

    @property
    def source(self) -> str:
        """What measures its drives, as in a Mark."""
        return changed(self.body)

    @property
    def is_controlled(self) -> bool:
        """Whether its controller runs."""
        return self._controller.get_num_connections() > 0

    @property
    def obstacle(self) -> Optional[Sentence]:
        """Why the robot cannot be judged now, or None."""
        return self._hindrance()[0]

    @property
    def advice(self) -> str:
        """What somebody at a terminal does about the obstacle, "" for nothing more."""
        return self._hindrance()[1]

    def _hindrance(self) -> Tuple[Optional[Sentence], str]:
        if self._silent_polls >= SILENT_POLLS:
            return say("simulator_silent"), ("Continue it (after Ctrl-Z: fg), or start it again: "
                                             "roslaunch simulation simulation.launch")
        if self._state is not UNKNOWN and not self.is_controlled:
            return say("controller_ended"), "Start it again: rosrun jetbot_control_node jetbot_controller.py"
        if self._state.cause in (*HOLDS, ENDED):
            is_released = self._state.cause in (EMERGENCY_STOP, OWN_EMERGENCY_STOP)
            return say(f"robot_{self._state.cause}"), RELEASE if is_released else ""
        if self._readers and self._readers.are_blind and not self.has_stopped:
            return say("nobody_looks"), ""
        return self._readers.problem if self._readers else None, ""

    def commanders(self) -> List[str]:
        """Return the nodes that publish commands for this robot; none if the master does not answer."""
        with contextlib.suppress(*NO_ANSWER):
            return [printable(node) for node in system_state()[0].get(f"{self.namespace}/cmd_vel", ())]
        return []

    def put_at_start(self) -> Iterator[None]:
        """Put the robot to its start; yield until the ground truth shows it there, or an obstacle."""
        if self._readers:
            self._readers.start()
        call = Thread(target=self._call_reset, daemon=True)  # a frozen simulator never answers
        call.start()
        while call.is_alive() and not self.obstacle:
            yield
        called_at = self.latest.time
        while not (self.has_stopped and self.latest.time - called_at >= STOPPED_AFTER or self.obstacle):
            yield

    def _call_reset(self):
        with contextlib.suppress(rospy.ServiceException):  # ground truth shows it
            self._reset()

    def set_world(self, text: str) -> None:
        """Put the world that is written in YAML around the robot; "" is the one that it started in."""
        self._known_worlds = self._worlds
        self._world.publish(text)

    @property
    def has_world(self) -> bool:
        """Whether the simulator has the world of the last ``set_world``; before the first one, that of its start."""
        return self._worlds > self._known_worlds
