"""What keeps a robot stopped, or programs from driving it, whatever is commanded, and how its status words it."""

from typing import NamedTuple


class Hold(NamedTuple):
    """Something that keeps the robot stopped, whatever is commanded: why, and what the end of that is called."""

    reason: str
    released: str


EMERGENCY_STOP = Hold("emergency stop", "the emergency stop was released")
OWN_EMERGENCY_STOP = Hold("its own emergency stop", "its own emergency stop was released")
NO_MASTER = Hold("no ROS master, so no emergency stop could arrive", "the ROS master is back")
SUSPENDED = Hold("its terminal is suspended (Ctrl-Z); fg resumes it", "its terminal was resumed")
MANUAL_PRIORITY = 5.0  # s after a command of the cockpit in which those of other programs are ignored
WAITING = "for the cockpit"  # a status says that these wait

HOLDS = (EMERGENCY_STOP, OWN_EMERGENCY_STOP, NO_MASTER, SUSPENDED)  # in the order in which they are reported
