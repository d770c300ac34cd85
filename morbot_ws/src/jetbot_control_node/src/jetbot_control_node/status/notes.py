"""What a robot does and why, and what a person should look at, each in a sentence. No ROS here."""

import math
from typing import Callable, Dict, List, NamedTuple, Optional, Sequence, Tuple

from jetbot import BusError, JetbotError
from jetbot.robot import Robot
from jetbot.text import enumeration
from jetbot_ros.state import DRIVING, STOPPED, Cause, RobotState, because, sentence

from ..control.state_machine import State
from ..control.supervisor import Step, Supervisor

LOOK_INTERVAL = 0.2  # s between two looks at what there is to note while nothing else changes
NOTE_FOR = 3.0       # s that a disturbance of the board is reported
LASTING = 0.5        # s that a condition lasts until it is reported: a ramp passes through some
MAX_NAMES = 3        # names that a status lists

DISTURBANCES = {  # count: from how many on it is reported, and how
    "resets": (1, "its board has lost its settings ({} so far): check the battery and the plugs"),
    "overwritten": (1, "another program writes to its board ({} so far)"),
    "faults": (2, "its board keeps failing to answer ({} so far): check the wires"),  # each has its status, too
}
FULL_POWER, MAX_DUTY = "both wheels at full power", "both wheels at max_duty"
TOO_SLOW = "the wheels get less than one step of the board, so they do not turn: "


class Status(NamedTuple):
    """fault: why the robot cannot be driven; notes: sentences, each a warning; waiting: as RobotState's."""

    state: State
    fault: Optional[JetbotError] = None
    notes: Tuple[str, ...] = ()
    waiting: Tuple[str, ...] = ()

    @property
    def cause(self) -> Optional[Cause]:
        """Why the robot is stopped, or None."""
        if not self.fault:
            return self.state.cause
        return because("board" if isinstance(self.fault, BusError) else "guard", problem=self.fault.reason)

    @property
    def text(self) -> str:
        """What the robot does, and what there is to say of it."""
        notes = () if self.fault or self.state.alarm else self.notes
        remarks = () if self.fault or self.state.holds or not self.waiting else (waiting_remark(self.waiting),)
        return ", ".join([sentence(self.cause), *notes, *remarks])

    @property
    def data(self) -> RobotState:
        """The same for programs, but for the bus."""
        cause, sender = self.cause, self.state.sender
        return RobotState(STOPPED if cause else DRIVING, self.text, cause.code if cause else "",
                          cause.arguments if cause else {}, self.state.holds, sender.name if sender else "",
                          self.waiting)

    @property
    def warning(self) -> bool:
        """Whether it is something that a person should look at."""
        return bool(self.fault or self.state.alarm or self.notes)


class StatusWatch:
    """The ``status`` of a supervisor, which it watches. on_change: called with each whose ``data`` differs.

    supply_note: returns what there is to say about the supply at a time, or None.
    """

    def __init__(self, supervisor: Supervisor, on_change: Callable[[Status], None],
                 supply_note: Callable[[float], Optional[str]] = lambda now: None):
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

    def _notes(self, step) -> List[str]:
        """Return a sentence for each thing that a person should look at."""
        now, robot = step.at, self._supervisor.robot
        notes = [rivals_note(self._supervisor, now), self._supply_note(now), full_power_note(robot),
                 self._too_slow.note(too_slow_note(robot, step.duties), now),
                 *self._disturbances.notes(disturbances(self._supervisor), now)]
        return [note for note in notes if note]


def rivals_note(supervisor: Supervisor, now: float) -> Optional[str]:
    """Return a sentence if more than one program commands the robot, and all count."""
    rivals = supervisor.commands.recent(now)
    if len(rivals) < 2 or supervisor.state.is_manual(now):
        return None
    return f"{len(rivals)} programs command it: {listed(rivals)}"


def waiting_programs(supervisor: Supervisor, now: float) -> List[str]:
    """Return the names of the programs whose commands are ignored while only manual ones count."""
    return supervisor.commands.waiting(now) if supervisor.state.is_manual(now) else []


def waiting_remark(names: Sequence[str]) -> str:
    """Return that these programs wait while only manual commands count. Nobody need look at that."""
    return f"{listed(names)} {'wait' if len(names) > 1 else 'waits'} for the cockpit"


def full_power_note(robot: Robot) -> Optional[str]:
    """Return a sentence if the robot turns or drives less than commanded, because both wheels are at their limit."""
    if not robot.at_full_power:
        return None
    return FULL_POWER if robot.left_motor.max_duty == 1 else MAX_DUTY


def too_slow_note(robot: Robot, duties: Sequence[float]) -> Optional[str]:
    """Return a sentence if the board rounds to 0 what it is given, although motion is commanded."""
    commanded = robot.left_motor.value or robot.right_motor.value
    if not commanded or max(map(abs, duties)) > robot.driver.resolution / 2:
        return None
    return TOO_SLOW + ("command more" if robot.driver.closed_loop else "raise min_duty")


class Lasting:
    """A condition that is reported only once it has lasted for ``LASTING`` seconds."""

    def __init__(self):
        self._since: Optional[float] = None

    def note(self, sentence: Optional[str], now: float) -> Optional[str]:
        """Return the sentence that describes the condition, or None while there is none, or it is too recent."""
        if sentence is None:
            self._since = None
            return None
        if self._since is None:
            self._since = now
        return sentence if now - self._since >= LASTING else None


def disturbances(supervisor: Supervisor) -> Dict[str, int]:
    """Return how often the board has lost its settings, been written to by another program, and failed to answer."""
    driver = supervisor.robot.driver
    return {"resets": driver.resets, "overwritten": driver.overwritten, "faults": supervisor.faults}


class Disturbances:
    """What has recently kept the board from driving as commanded, from counts that only grow."""

    def __init__(self):
        self._counts = dict.fromkeys(DISTURBANCES, 0)
        self._seen_at: Dict[str, float] = {}

    def notes(self, counts: Dict[str, int], now: float) -> List[str]:
        """Return a sentence for each count that has grown within ``NOTE_FOR`` seconds. counts: as DISTURBANCES."""
        self._seen_at.update({name: now for name, count in counts.items() if count > self._counts[name]})
        self._counts = counts
        return [sentence.format(counts[name]) for name, (threshold, sentence) in DISTURBANCES.items()
                if counts[name] >= threshold and now - self._seen_at[name] < NOTE_FOR]


def listed(names: Sequence[str]) -> str:
    """Return the names in one phrase, the first few of many."""
    if len(names) > MAX_NAMES:
        names = [*names[:MAX_NAMES - 1], f"{len(names) - MAX_NAMES + 1} more"]
    return enumeration(names)
