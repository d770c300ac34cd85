"""The body of a JetBot that is not there: ``Body`` moves as its motors are driven."""

from .body import Body
from .motor import Motor
from .pose import ORIGIN, Pose

__all__ = ["ORIGIN", "Body", "Motor", "Pose"]
