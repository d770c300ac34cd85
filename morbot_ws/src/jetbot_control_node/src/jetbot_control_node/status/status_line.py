"""What the robot does and why, in one sentence: of each change, and looked at every LOOK_INTERVAL. No ROS here."""

import math
from typing import Callable, List, NamedTuple, Optional, Tuple

from jetbot import JetbotError

from ..control.supervisor import Step, Supervisor
from .warnings import (
    Disturbances,
    Lasting,
    disturbances,
    full_power_note,
    rivals_note,
    too_slow_note,
    waiting_remark,
)

LOOK_INTERVAL = 0.2  # s between two looks at the warnings while nothing else changes


class Status(NamedTuple):
    """reason, alarm: of the State; held: whether a hold keeps it stopped; fault: why the robot cannot be driven.

    notes: what else there is, with a warning; remark: the same, without one.
    """

    reason: str
    alarm: bool = False
    held: bool = False
    fault: Optional[JetbotError] = None
    notes: Tuple[str, ...] = ()
    remark: Optional[str] = None

    @property
    def text(self) -> str:
        if self.fault:
            return f"stopped: {self.fault.reason}, trying again"
        remarks = [self.remark] if self.remark and not self.held else []
        return ", ".join([self.reason, *(() if self.alarm else self.notes), *remarks])

    @property
    def warning(self) -> bool:
        """Whether it is something that a person should look at."""
        return bool(self.fault or self.alarm or self.notes)


class StatusLine:
    """The ``status`` of a supervisor, which it watches. on_change: called with each that reads differently.

    supply_note: returns what there is to say about the supply at a time, or None.
    """

    def __init__(self, supervisor: Supervisor, on_change: Callable[[Status], None],
                 supply_note: Callable[[float], Optional[str]] = lambda now: None):
        self._supervisor, self._on_change, self._supply_note = supervisor, on_change, supply_note
        self._disturbances, self._too_slow = Disturbances(), Lasting()
        self.status = Status(supervisor.state.reason)
        self._text, self._made_of, self._looked_at = None, None, -math.inf

    def __call__(self, step: Step) -> None:
        made_of = step.state.reason, step.fault
        if made_of == self._made_of and step.at - self._looked_at < LOOK_INTERVAL:
            return
        self._made_of, self._looked_at = made_of, step.at
        self.status = status = Status(step.state.reason, step.state.alarm, bool(step.state.holds), step.fault,
                                      tuple(self._notes(step)), waiting_remark(self._supervisor, step.at))
        if status.text != self._text:
            self._text = status.text
            self._on_change(status)

    def _notes(self, step) -> List[str]:
        """Return a sentence for each thing that a person should look at."""
        now, robot = step.at, self._supervisor.robot
        notes = [rivals_note(self._supervisor, now), self._supply_note(now), full_power_note(robot),
                 self._too_slow.note(too_slow_note(robot, step.duties), now),
                 *self._disturbances.notes(disturbances(self._supervisor), now)]
        return [note for note in notes if note]
