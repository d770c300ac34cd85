"""A robot's state as data: what its controller publishes as ``~state``, and programs read. No ROS here."""

from typing import Dict, Mapping, NamedTuple, Optional, Tuple

from jetbot.sentence import Sentence, dump, load, read_row, row
from jetbot.text import printable

MANUAL_PRIORITY = 5.0  # s after a command of the cockpit in which those of other programs are ignored
MAX_LENGTH = 300       # characters of a value that are read

DRIVING, STOPPED, ENDED = "driving", "stopped", "ended"

# What keeps a robot stopped, whatever is commanded, in the order in which they are reported
HOLDS = EMERGENCY_STOP, OWN_EMERGENCY_STOP, NO_MASTER, SUSPENDED = (
    "emergency_stop", "own_emergency_stop", "no_master", "suspended")

CAUSES = {  # why a robot is stopped: a code for programs, and how its status words it
    EMERGENCY_STOP: "emergency stop",
    OWN_EMERGENCY_STOP: "its own emergency stop",
    NO_MASTER: "no ROS master, so no emergency stop could arrive",
    SUSPENDED: "its terminal is suspended (Ctrl-Z); fg resumes it",
    "emergency_stop_released": "no command since the emergency stop was released",
    "own_emergency_stop_released": "no command since its own emergency stop was released",
    "no_master_released": "no command since the ROS master is back",
    "suspended_released": "no command since its terminal was resumed",
    "no_command_yet": "no command yet",
    "zero": "the command is zero",
    "not_finite": "command was not finite",
    "no_command": "no command for {seconds} s (repeat it: rostopic pub -r 10)",
    "old_command": "the command of {program} is from before, repeat it",
    "program_ended": "{program} has ended",
    "nobody": "nobody is left to send commands",
    "program_silent": "{program} does not answer",
    "board": "{problem}, trying again",
    "guard": "{problem}, trying again",
    ENDED: "the controller has ended",
}


Cause = Sentence  # of CAUSES


def because(code: str, **arguments: str) -> Cause:
    """Return a Cause."""
    return row(CAUSES, code, **arguments)


class RobotState(NamedTuple):
    """What a robot does and why.

    state: DRIVING, STOPPED or ENDED, "" if it is not known; sentence: the same, for people; cause: a code of CAUSES, ""
    while it drives; arguments: what the cause names; holds: those of HOLDS that are engaged; commanded_by: the node
    whose command counts, or ""; waiting: the nodes whose commands are ignored while a person drives; remarks: what the
    sentence says besides the cause, None if it is not known as data; bus: its board's bus or port.
    """

    state: str = ""
    sentence: str = ""
    cause: str = ""
    arguments: Mapping[str, str] = {}
    holds: Tuple[str, ...] = ()
    commanded_by: str = ""
    waiting: Tuple[str, ...] = ()
    remarks: Optional[Tuple[Sentence, ...]] = None
    bus: str = ""

    @property
    def template(self) -> str:
        """The template of its cause; "" while it drives, and where an argument is missing."""
        cause = read_row(CAUSES, self.cause, self.arguments)
        return cause.template if cause else ""

    def values(self) -> Dict[str, str]:
        """Return the values of the message, whose text is the sentence."""
        return {"state": self.state, "cause": self.cause, **self.arguments, "holds": " ".join(self.holds),
                "commanded_by": self.commanded_by, "waiting": " ".join(self.waiting),
                "remarks": "" if self.remarks is None else dump(self.remarks), "bus": self.bus}


UNKNOWN = RobotState()


def read(message) -> RobotState:
    """Return what a message of ``~state`` (diagnostic_msgs/DiagnosticStatus) says."""
    values = {item.key: printable(item.value)[:MAX_LENGTH] for item in message.values}
    state, cause, holds, commanded_by, waiting, bus = (
        values.pop(key, "") for key in ("state", "cause", "holds", "commanded_by", "waiting", "bus"))
    known = read_row(CAUSES, cause, values)
    remarks = next((item.value for item in message.values if item.key == "remarks"), "")
    return RobotState(state, printable(message.message)[:MAX_LENGTH], cause, known.arguments if known else {},
                      tuple(holds.split()), commanded_by, tuple(waiting.split()), load(remarks), bus)


def sentence(cause: Optional[Cause]) -> str:
    """Return what a robot does, for people. cause: why it is stopped, or None while it drives."""
    return f"stopped: {cause}" if cause else DRIVING
