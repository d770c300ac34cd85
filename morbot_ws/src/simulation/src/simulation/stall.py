"""What the simulator reports of wheels that get too little power to turn."""

from typing import Dict, Optional

from jetbot_control_node.notes import Lasting


class StallReport:
    """Reports a stall once: until other wheels stall, or these turn, or get no power."""

    def __init__(self):
        self._lasting = Lasting()
        self._reported = ()

    def update(self, duties: Dict[str, float], fixed_pwm: bool, now: float) -> Optional[str]:
        """Return the sentence that is due now, or None.

        duties: as ``DiffDriveModel.stalled``; fixed_pwm: whether the board's PWM frequency cannot be set; now: in s.
        """
        sentence = self._lasting.note(describe(duties, fixed_pwm) if duties else None, now)
        wheels = tuple(duties) if sentence else ()
        changed, self._reported = wheels != self._reported, wheels
        return sentence if changed else None


def describe(duties: Dict[str, float], fixed_pwm: bool) -> str:
    """Return a sentence about the wheels that do not turn at these duties, with the largest of them, and advice."""
    wheels = "wheels get" if len(duties) > 1 else f"{''.join(duties)} wheel gets"
    percent = 100 * max(map(abs, duties.values()))
    advice = "raise min_duty" if fixed_pwm else "raise min_duty, or lower pwm_frequency"
    return f"the {wheels} {percent:.2g} % of full power, too little to turn: {advice}"
