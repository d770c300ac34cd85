"""What a robot does and why, and what a person should look at, each in a sentence. No ROS here."""

import math
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

from jetbot import BusError, JetbotError
from jetbot.robot import Robot
from jetbot.sentence import Sentence
from jetbot_ros.state import DRIVING, STOPPED, Cause, RobotState, because, sentence

from ..control.state_machine import State
from ..control.supervisor import Step, Supervisor
from .remarks import of_programs, remark

LOOK_INTERVAL = 0.2  # s between two looks at what there is to note while nothing else changes
NOTE_FOR = 3.0       # s that a disturbance of the board is reported
LASTING = 0.5        # s that a condition lasts until it is reported: a ramp passes through some

# From how many on each is reported; each fault has its status, too
DISTURBANCES = {"resets": 1, "overwritten": 1, "faults": 2}


class Status(NamedTuple):
    """fault: why the robot cannot be driven; notes: each a warning; waiting: as RobotState's."""

    state: State
    fault: Optional[JetbotError] = None
    notes: Tuple[Sentence, ...] = ()
    waiting: Tuple[str, ...] = ()

    @property
    def cause(self) -> Optional[Cause]:
        """Why the robot is stopped, or None."""
        if not self.fault:
            return self.state.cause
        return because("board" if isinstance(self.fault, BusError) else "guard", problem=self.fault.reason)

    @property
    def remarks(self) -> Tuple[Sentence, ...]:
        """What there is to say of the robot besides what it does."""
        notes = () if self.fault or self.state.alarm else self.notes
        waiting = () if self.fault or self.state.holds or not self.waiting else (waiting_remark(self.waiting),)
        return (*notes, *waiting)

    @property
    def text(self) -> str:
        """What the robot does, and what there is to say of it."""
        return ", ".join([sentence(self.cause), *map(str, self.remarks)])

    @property
    def data(self) -> RobotState:
        """The same for programs, but for the bus."""
        cause, sender = self.cause, self.state.sender
        return RobotState(STOPPED if cause else DRIVING, self.text, cause.code if cause else "",
                          cause.arguments if cause else {}, self.state.holds, sender.name if sender else "",
                          self.waiting, self.remarks)

    @property
    def warning(self) -> bool:
        """Whether it is something that a person should look at."""
        return bool(self.fault or self.state.alarm or self.notes)


class StatusWatch:
    """The ``status`` of a supervisor, which it watches. on_change: called with each whose ``data`` differs.

    supply_note: returns what there is to say about the supply at a time, or None.
    """

    def __init__(self, supervisor: Supervisor, on_change: Callable[[Status], None],
                 supply_note: Callable[[float], Optional[Sentence]] = lambda now: None):
        self._supervisor, self._on_change, self._supply_note = supervisor, on_change, supply_note
        self._disturbances, self._too_slow = Disturbances(), Lasting()
        self.status = Status(supervisor.state)
        self._data, self._made_of, self._looked_at = None, None, -math.inf

    def __call__(self, step: Step) -> None:
        made_of = step.state.cause, step.fault
        if made_of == self._made_of and step.at - self._looked_at < LOOK_INTERVAL:
            return
        self._made_of, self._looked_at = made_of, step.at
        self.status = status = Status(step.state, step.fault, tuple(self._notes(step)),
                                      tuple(waiting_programs(self._supervisor, step.at)))
        if status.data != self._data:
            self._data = status.data
            self._on_change(status)

    def _notes(self, step) -> List[Sentence]:
        """Return a remark on each thing that a person should look at."""
        now, robot = step.at, self._supervisor.robot
        notes = [rivals_note(self._supervisor, now), self._supply_note(now), full_power_note(robot),
                 self._too_slow.note(too_slow_note(robot, step.duties), now),
                 *self._disturbances.notes(disturbances(self._supervisor), now)]
        return [note for note in notes if note]


def rivals_note(supervisor: Supervisor, now: float) -> Optional[Sentence]:
    """Return a remark if more than one program commands the robot, and all count."""
    rivals = supervisor.commands.recent(now)
    return of_programs("rivals", rivals) if len(rivals) > 1 and not supervisor.state.is_manual(now) else None


def waiting_programs(supervisor: Supervisor, now: float) -> List[str]:
    """Return the names of the programs whose commands are ignored while only manual ones count."""
    return supervisor.commands.waiting(now) if supervisor.state.is_manual(now) else []


def waiting_remark(names: Sequence[str]) -> Sentence:
    """Return that these programs wait while only manual commands count. Nobody need look at that."""
    return of_programs("waiting", names)


def full_power_note(robot: Robot) -> Optional[Sentence]:
    """Return a remark if the robot turns or drives less than commanded, because both wheels are at their limit."""
    if not robot.at_full_power:
        return None
    return remark("full_power" if robot.left_motor.max_duty == 1 else "max_duty")


def too_slow_note(robot: Robot, duties: Sequence[float]) -> Optional[Sentence]:
    """Return a remark if the board rounds to 0 what it is given, although motion is commanded."""
    commanded = robot.left_motor.value or robot.right_motor.value
    if not commanded or max(map(abs, duties)) > robot.driver.resolution / 2:
        return None
    return remark("too_slow_closed_loop" if robot.driver.closed_loop else "too_slow")


class Lasting:
    """A condition that is reported only once it has lasted for ``LASTING`` seconds."""

    def __init__(self):
        self._since: Optional[float] = None

    def note(self, note: Optional[Sentence], now: float) -> Optional[Sentence]:
        """Return the remark on the condition, or None while there is none, or it is too recent."""
        if note is None:
            self._since = None
            return None
        if self._since is None:
            self._since = now
        return note if now - self._since >= LASTING else None


def disturbances(supervisor: Supervisor) -> Dict[str, int]:
    """Return how often the board has lost its settings, been written to by another program, and failed to answer."""
    driver = supervisor.robot.driver
    return {"resets": driver.resets, "overwritten": driver.overwritten, "faults": supervisor.faults}


class Disturbances:
    """What has recently kept the board from driving as commanded, from counts that only grow."""

    def __init__(self):
        self._counts = dict.fromkeys(DISTURBANCES, 0)
        self._seen_at: Dict[str, float] = {}

    def notes(self, counts: Dict[str, int], now: float) -> List[Sentence]:
        """Return a remark on each count that has grown within ``NOTE_FOR`` seconds. counts: as DISTURBANCES."""
        self._seen_at.update({name: now for name, count in counts.items() if count > self._counts[name]})
        self._counts = counts
        return [remark(name, count=counts[name]) for name, threshold in DISTURBANCES.items()
                if counts[name] >= threshold and now - self._seen_at[name] < NOTE_FOR]
