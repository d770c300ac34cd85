"""What the robot does and why, in one sentence: of each change, and looked at every LOOK_INTERVAL. No ROS here."""

import math
from typing import Callable, List, NamedTuple, Optional, Tuple

from jetbot import BusError, JetbotError
from jetbot_ros.state import DRIVING, STOPPED, Cause, RobotState, because, sentence

from ..control.supervisor import Step, Supervisor
from .warnings import (
    Disturbances,
    Lasting,
    disturbances,
    full_power_note,
    rivals_note,
    too_slow_note,
    waiting_programs,
    waiting_remark,
)

LOOK_INTERVAL = 0.2  # s between two looks at the warnings while nothing else changes


class Status(NamedTuple):
    """cause, alarm, holds: of the State; fault: why the robot cannot be driven; notes: sentences, each a warning.

    commanded_by: the program whose command counts, or ""; waiting: those that wait while a person drives.
    """

    cause: Optional[Cause]
    alarm: bool = False
    holds: Tuple[str, ...] = ()
    fault: Optional[JetbotError] = None
    notes: Tuple[str, ...] = ()
    commanded_by: str = ""
    waiting: Tuple[str, ...] = ()

    @property
    def text(self) -> str:
        if self.fault:
            return sentence(self._why)
        remarks = [waiting_remark(self.waiting)] if self.waiting and not self.holds else []
        return ", ".join([sentence(self.cause), *(() if self.alarm else self.notes), *remarks])

    @property
    def data(self) -> RobotState:
        """The same for programs, but for the bus."""
        cause = self._why
        return RobotState(STOPPED if cause else DRIVING, self.text, cause.code if cause else "",
                          dict(cause.arguments) if cause else {}, self.holds, self.commanded_by, self.waiting)

    @property
    def _why(self) -> Optional[Cause]:
        if not self.fault:
            return self.cause
        return because("board" if isinstance(self.fault, BusError) else "guard", problem=self.fault.reason)

    @property
    def warning(self) -> bool:
        """Whether it is something that a person should look at."""
        return bool(self.fault or self.alarm or self.notes)


class StatusLine:
    """The ``status`` of a supervisor, which it watches. on_change: called with each whose ``data`` differs.

    supply_note: returns what there is to say about the supply at a time, or None.
    """

    def __init__(self, supervisor: Supervisor, on_change: Callable[[Status], None],
                 supply_note: Callable[[float], Optional[str]] = lambda now: None):
        self._supervisor, self._on_change, self._supply_note = supervisor, on_change, supply_note
        self._disturbances, self._too_slow = Disturbances(), Lasting()
        self.status = Status(supervisor.state.cause)
        self._data, self._made_of, self._looked_at = None, None, -math.inf

    def __call__(self, step: Step) -> None:
        made_of = step.state.cause, step.fault
        if made_of == self._made_of and step.at - self._looked_at < LOOK_INTERVAL:
            return
        self._made_of, self._looked_at = made_of, step.at
        state = step.state
        self.status = status = Status(
            state.cause, state.alarm, state.holds, step.fault, tuple(self._notes(step)),
            state.sender.name if state.sender else "", tuple(waiting_programs(self._supervisor, step.at)))
        data = status.data
        if data != self._data:
            self._data = data
            self._on_change(status)

    def _notes(self, step) -> List[str]:
        """Return a sentence for each thing that a person should look at."""
        now, robot = step.at, self._supervisor.robot
        notes = [rivals_note(self._supervisor, now), self._supply_note(now), full_power_note(robot),
                 self._too_slow.note(too_slow_note(robot, step.duties), now),
                 *self._disturbances.notes(disturbances(self._supervisor), now)]
        return [note for note in notes if note]
