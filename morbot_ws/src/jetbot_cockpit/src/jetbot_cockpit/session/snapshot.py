"""What the robots report, as immutable values, and how the messages of the socket carry it."""

from typing import Dict, FrozenSet, List, NamedTuple, Optional, Tuple

from jetbot.fake import folder_of
from jetbot.health import Health
from jetbot.sentence import Sentence, as_data
from jetbot.text import enumeration
from jetbot_ros.state import EMERGENCY_STOP, UNKNOWN, RobotState

from ..notices import Notice, say

WORKSHOP = 2.0, 1.0  # wheel_separation in m and max_speed in m/s: the workshop's x - z, x + z
MAX_LABEL = 40  # characters


class TaskSnapshot(NamedTuple):
    """A driving task. text: in English; seconds: of the drive; score: 0 to 100, once done, with driver: the name of who
    drove, "" if it is not known; request: which one its judge answers, "" for none.

    sentences: the text as data, () if it is not known so; once done, what lost most points, with lost: how many, None
    if it is not worth a sentence.
    """

    name: str
    title: str
    state: str
    text: str
    seconds: Optional[float] = None
    score: Optional[float] = None
    driver: str = ""
    request: str = ""
    sentences: Tuple[Sentence, ...] = ()
    lost: Optional[float] = None

    def message(self) -> dict:
        """Return it as a part of the message "state"."""
        return {**self._asdict(), "sentences": as_data(self.sentences)}


class Shape(NamedTuple):
    """A polyline on the map, in m. kind: wall, line, course or goal, which is an arrow that begins there."""

    kind: str
    width: float
    points: Tuple[Tuple[float, float], ...]


class RobotSnapshot(NamedTuple):
    """A robot at one moment; what is not known is None.

    id: its namespace; geometry: (wheel_separation in m, max_speed in m/s) of its commands; simulated: whether it can
    be put back to its start; state: its controller's; stopped: by its own emergency stop;
    pose: (x, y in m, yaw in rad) on the map; speed: the measured one, and command: the driven one, each in m/s and
    rad/s; wheels: the duties (left, right) in [-1, 1]; program: whose command it drives, "" if that is the cockpit's;
    shapes: what is drawn around it; task: which one it drives; judged_elsewhere: whether judge.py judges it;
    health: how its battery and its computer are.
    """

    id: str
    color: str = "#888888"
    geometry: Optional[Tuple[float, float]] = None
    simulated: bool = False
    state: RobotState = UNKNOWN
    warning: bool = False
    answers: bool = True
    stopped: bool = False
    pose: Optional[Tuple[float, float, float]] = None
    speed: Optional[Tuple[float, float]] = None
    command: Optional[Tuple[float, float]] = None
    wheels: Optional[Tuple[float, float]] = None
    program: str = ""
    shapes: Tuple[Shape, ...] = ()
    task: Optional[TaskSnapshot] = None
    judged_elsewhere: bool = False
    health: Optional[Tuple[Health, ...]] = None

    @property
    def label(self) -> str:
        """Its name on the page."""
        return label(self.id)

    @property
    def problem(self) -> Optional[Notice]:
        """Why nobody can drive it, or None."""
        if not self.answers:
            return say("no_answer", robot=self.label)
        return say("stopped", robot=self.label) if self.stopped else None

    @property
    def programs_wait(self) -> bool:
        """Whether it is stopped, and ignores what programs command, because of a person."""
        return bool(self.state.cause and self.state.waiting)

    def velocity(self, forward: float, left: float) -> Tuple[float, float]:
        """Return the command (m/s, rad/s) of a pad; full deflection turns the wheels at full power."""
        wheel_separation, max_speed = self.geometry or WORKSHOP
        return forward * max_speed, left * 2 * max_speed / wheel_separation

    def description(self) -> dict:
        """Return its entry of the message "robots"."""
        wheel_separation, max_speed = self.geometry or WORKSHOP
        return {"id": self.id, "label": self.label, "color": self.color,
                "workshop": self.geometry and self.geometry == WORKSHOP,
                "wheel_separation": wheel_separation, "max_speed": max_speed, "simulated": self.simulated,
                "pupil": "", "version": "", "address": ""}

    def message(self, driver: Optional[dict], resumes: Optional[int], held: Optional[str], task: Optional[TaskSnapshot],
              stalls: int, pictures: Optional[dict], programs: int) -> dict:
        """Return its entry of the message "state"; docs/protocol.md explains it."""
        state = self.state
        own = "warning", "answers", "stopped", "pose", "speed", "command", "wheels", "program"
        return {"status": state.sentence, "state": state.state, "cause": state.cause, "template": state.template,
                "arguments": state.arguments, "remarks": None if state.remarks is None else as_data(state.remarks),
                "health": None if self.health is None else [row._asdict() for row in self.health],
                "holds": state.holds, "waiting": state.waiting, "fake": bool(folder_of(state.bus)),
                **{name: getattr(self, name) for name in own},
                "driver": driver, "resumes": resumes, "held": held, "stalls": stalls, "task": task and task.message(),
                "pictures": pictures, "programs": programs, "link": None}


class Snapshot(NamedTuple):
    """All robots at one moment. master: whether the ROS master answers; emergency: the stop of all robots.

    stopped_elsewhere: whose emergency stops another program has engaged, None: that of all.
    """

    robots: Dict[str, RobotSnapshot] = {}
    master: bool = True
    emergency: bool = False
    stopped_elsewhere: FrozenSet[Optional[str]] = frozenset()

    def ended(self, robot: Optional[str]) -> Optional[Notice]:
        """Return that this robot has ended, or None, also for all robots (None)."""
        return None if robot is None or robot in self.robots else say("ended", robot=label(robot))

    def problem(self, robot: str) -> Optional[Notice]:
        """Return why nobody can drive this robot, or None."""
        if not self.master:
            return say("no_master")
        return self.ended(robot) or (say("all_stopped") if self.emergency else self.robots[robot].problem)

    def unconfirmed(self) -> List[str]:
        """Return which robots have not said that the emergency stop of all robots, which is engaged, holds them."""
        stopped = {name for name, robot in self.robots.items() if EMERGENCY_STOP in robot.state.holds}
        return [name for name in self.robots if self.emergency and name not in stopped]

    def is_stopped(self, robot: Optional[str]) -> bool:
        """Return whether the emergency stop of this robot, or of all (None), may be engaged."""
        return self.emergency if robot is None else robot not in self.robots or self.robots[robot].stopped

    def may_be_stopped(self, robot: Optional[str]) -> bool:
        """Return whether that stop is engaged, or not known yet, as just after this node's start."""
        robots = [self.robots[robot]] if robot else self.robots.values()
        return self.is_stopped(robot) or not robots or any(each.state is UNKNOWN for each in robots)

    def is_stopped_here(self, robot: Optional[str]) -> bool:
        """Return whether that stop may be engaged, and by no other program."""
        return self.is_stopped(robot) and robot not in self.stopped_elsewhere

    def changes_since(self, before: "Snapshot") -> List[str]:
        """Return a sentence for the terminal for each way in which robots have come, ended or fallen silent."""
        old, new = before.robots, self.robots
        kept = [robot for robot in new if robot in old and old[robot].answers != new[robot].answers]
        changes = {"on the page": [robot for robot in new if robot not in old],
                   "ended": [robot for robot in old if robot not in new],
                   "not answering": [robot for robot in kept if not new[robot].answers],
                   "answering again": [robot for robot in kept if new[robot].answers]}
        return [f"{change}: {enumeration(list(map(label, robots)))}" for change, robots in changes.items() if robots]


def label(robot: str) -> str:
    """Return a robot's name on the page, by its namespace."""
    name = "".join(each if each.isprintable() else "?" for each in robot.strip("/")[:MAX_LABEL])
    return name or "robot"
