"""What the status reports beside "driving": programs that contradict each other, and what costs motion."""

import math
from typing import Callable, Collection, Dict, List, Optional, Set, Tuple

from jetbot import Robot
from jetbot.text import enumeration

from .safety import Sender

# Called after each step with what the wheels (left, right) are given, as ``Robot.duties``, and the time in s.
Observer = Callable[[Tuple[float, float], float], Optional[str]]

RIVALS_WITHIN = 1.5  # s between commands of two programs that contradict each other
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


class Commanders:
    """Which programs command the robot. ``record`` may be called from any thread."""

    def __init__(self):
        self._commanded_at: Dict[str, float] = {}
        self._manual: Set[str] = set()

    def record(self, sender: Sender, now: float) -> None:
        """A program has sent a command; a latched one counts as long as the program runs."""
        self._commanded_at[sender.name] = math.inf if sender.latched else now
        if sender.manual:
            self._manual.add(sender.name)

    def note(self, senders: Collection[str], now: float) -> Optional[str]:
        """Return a sentence if more than one of these programs commands the robot, else None."""
        rivals = self._recent(senders, now)
        return f"{len(rivals)} programs command it: {listed(rivals)}" if len(rivals) > 1 else None

    def ignored(self, senders: Collection[str], now: float) -> Optional[str]:
        """Return a sentence if others of these programs send commands while only manual ones count, else None."""
        others = [name for name in self._recent(senders, now) if name not in self._manual]
        return f"{listed(others)} {'wait' if len(others) > 1 else 'waits'} for the cockpit" if others else None

    def _recent(self, senders, now):
        for name, commanded_at in list(self._commanded_at.items()):
            if now - commanded_at >= RIVALS_WITHIN or name not in senders:
                self._commanded_at.pop(name)
        return sorted(self._commanded_at)


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


class FullPower:
    """An observer: reports that a robot turns less than commanded, because both wheels are at their limit."""

    def __init__(self, robot: Robot):
        self._robot = robot

    def __call__(self, duties: Tuple[float, float], now: float) -> Optional[str]:
        if not self._robot.at_full_power:
            return None
        return FULL_POWER if self._robot.left_motor.max_duty == 1 else MAX_DUTY


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


class TooSlow:
    """An observer: reports that the board rounds to 0 what it is given, although motion is commanded."""

    def __init__(self, robot: Robot):
        self._robot, self._lasting = robot, Lasting()

    def __call__(self, duties: Tuple[float, float], now: float) -> Optional[str]:
        driver = self._robot.driver
        commanded = self._robot.left_motor.value or self._robot.right_motor.value
        if not commanded or max(map(abs, duties)) > driver.resolution / 2:
            return self._lasting.note(None, now)
        return self._lasting.note(TOO_SLOW + ("command more" if driver.closed_loop else "raise min_duty"), now)


def listed(names: List[str]) -> str:
    """Return the names in one phrase, the first few of many."""
    if len(names) > MAX_NAMES:
        names = names[:MAX_NAMES - 1] + [f"{len(names) - MAX_NAMES + 1} more"]
    return enumeration(names)
