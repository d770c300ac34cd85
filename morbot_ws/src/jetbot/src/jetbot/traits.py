"""Motors whose ``value`` is a trait, which ``traitlets.link``, ``dlink`` and ``observe`` take."""

import threading
from typing import Any, Dict, Optional

import traitlets
from traitlets.utils.bunch import Bunch

from . import motor, robot

speed = vars(motor.Motor)["value"]  # the property


class Speed(traitlets.TraitType):
    """The trait of a speed: the robot keeps, checks and drives it."""

    def get(self, obj: "Motor", cls: Optional[type] = None) -> float:
        """Return the speed."""
        return speed.__get__(obj)

    def set(self, obj: "Motor", value: float) -> None:
        """Drive the wheel."""
        speed.__set__(obj, value)


class Motor(motor.Motor, traitlets.HasTraits):
    """A motor whose ``value`` is a trait."""

    value = Speed(0.0)

    def __init__(self, *options: Any):
        super().__init__(*options)
        self.observed = False  # ever; until then, a command takes no longer than without traits
        self._published, self._publishing = 0.0, threading.Lock()

    def observe(self, *args: Any, **options: Any) -> None:
        """As of HasTraits."""
        super().observe(*args, **options)
        if not self.observed:
            self._published, self.observed = self.value, True

    def publish(self) -> None:
        """Call the observers if the speed has changed, one thread at a time; no thread waits for another's observers.

        If the speed changes meanwhile, they are called once more: what they see last is the speed.
        """
        while self.observed and self._published != self.value and self._publishing.acquire(blocking=False):
            try:
                old, self._published = self._published, self.value
                self.notify_change(Bunch(name="value", old=old, new=self._published, owner=self, type="change"))
            finally:
                self._publishing.release()


class Robot(robot.Robot):
    __doc__ = robot.Robot.__doc__
    motor_class = Motor
    left_motor: Motor
    right_motor: Motor

    def command(self, speeds: Dict[motor.Motor, float]) -> None:
        """Drive the wheels; only then call the observers, which must not run while this thread holds up others."""
        try:
            super().command(speeds)
        finally:
            self.left_motor.publish()
            self.right_motor.publish()
