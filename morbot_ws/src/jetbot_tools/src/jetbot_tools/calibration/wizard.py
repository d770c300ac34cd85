"""Asks how a robot is wired and how it drives, by short motions, each announced and stopped by any key."""

import time
from typing import Any, List, Optional, Sequence

from jetbot.boards import BOARDS
from jetbot.errors import InvalidValue, JetbotError
from jetbot.robot import Robot
from jetbot_control_node.status.summary import GEOMETRY

from ..terminal import YES_OR_NO, choose, key_pressed, offset, single_keys
from . import tape_measure
from .corrections import ALPHAS, base_wiring, curvature_of, motor_wiring, trim
from .motions import DRIVE_SPEED, WheelStep, constant_speed, gentle

# Hz, where it can be set. Adafruit, "Improve Low-Speed Performance of Brushed DC Motors": 50 to 100 Hz; TT motors then
# start at a duty several times lower than at 1600 Hz.
PWM_FREQUENCY = 50
TURN_SPEED = 0.5  # fraction of full power
TURN_TIME = 0.8   # s
LINE_TIME = 4.0   # s
RAMP = [0.003 * 1.007 ** step for step in range(760)]  # duties, to 60 % in 17 s; in 0.3 s, a person is 10 % late
MAX_DELAY = 0.5   # s by which a step may be late; later, the guard may have stopped the wheels meanwhile

DIRECTIONS = {"forward": 1, "backward": -1}


class Wizard:
    """Collects the ``parameters`` and the ``dead_band`` of one robot, whose board takes a duty for each wheel."""

    wiring = staticmethod(motor_wiring)
    dead_band = 0.0  # smallest duty that turns both wheels; 0: not measured

    def __init__(self, **known: Any):
        fixed = "pwm_frequency" in BOARDS[known["board"]].driver.ignores
        self.parameters = known if fixed else {**known, "pwm_frequency": PWM_FREQUENCY}

    def drive_until_key(self, announcement: str, motion: Sequence[WheelStep]) -> Optional[WheelStep]:
        """Wait for Enter, then drive one step after the other.

        Returns the step at which a key was pressed, this program was held up, or its guard was lost; None if it drove
        them all. Raises KeyboardInterrupt for an abort key.
        """
        input(f"\n{announcement} Press Enter to start; any key stops it. ")
        options = {name: value for name, value in self.parameters.items() if name not in GEOMETRY}
        with single_keys(), Robot(**options) as robot:
            robot.set_motors(motion[0].left, motion[0].right)  # waits for the guard
            end = time.monotonic()
            for step in motion:
                robot.set_motors(step.left, step.right)
                robot.keep_alive()
                robot.verify()
                end += step.seconds
                stopped = key_pressed(max(0.0, end - time.monotonic())) or not robot.guarded
                if stopped or time.monotonic() > end + MAX_DELAY:
                    return step
        return None

    def find_motors(self) -> bool:
        """Find how the motors are wired; return whether any wheel turned. Raise JetbotError if only one did."""
        while True:
            seen = self.observe_motions()
            if not any(seen):
                return False
            if not all(seen):
                raise JetbotError("only one motor turns",
                                  "Check the plug and the wires of the other one, and start again.")
            try:
                self.parameters.update(self.wiring(*seen))
                return True
            except InvalidValue as error:
                print(error)

    def observe_motions(self) -> List[Any]:
        """Drive one output after the other forward; return the Turn that each causes, or None."""
        turns = []
        for output, speeds in ("left", (TURN_SPEED, 0)), ("right", (0, TURN_SPEED)):
            self.drive_until_key(f"The {output} output will turn one wheel briefly.",
                                 constant_speed(*speeds, TURN_TIME))
            wheel = choose("Which wheel turned?", {"left": "left", "right": "right", "none": None})
            turns.append(wheel and (wheel, choose("Forward or backward?", DIRECTIONS)))
        return turns

    def tune(self) -> None:
        """Find the parameters that a robot on the floor shows: how its wheels turn, how far it drives and turns."""
        self.straighten()
        tape_measure.measure(self.drive_until_key, self.parameters)

    def straighten(self) -> None:
        """Find the smallest duty at which both wheels turn, and the alphas at which they turn equally fast."""
        input("\nPut the robot on the floor, at the start of a straight line of two metres. Press Enter to continue. ")
        self.parameters["min_duty"] = self.dead_band = max(self.ramp("left", 1, 0), self.ramp("right", 0, 1))
        alphas = (1.0, 1.0)
        while True:
            self.parameters.update(zip(ALPHAS, alphas))
            self.drive_until_key(f"The robot will drive ahead for {LINE_TIME:.0f} s.",
                                 gentle(DRIVE_SPEED, DRIVE_SPEED, LINE_TIME, self.parameters["min_duty"]))
            drift = offset("How many centimetres off the line was it after one metre? "
                           "Press Enter alone if that is straight enough.", 90, {"left": 1, "right": -1}) / 100
            if not drift:
                return
            alphas = trim(*alphas, curvature_of(drift), self.parameters["min_duty"])
            print("The trim is changed. Put the robot back at the start.")

    def ramp(self, wheel: str, left: int, right: int) -> float:
        """Raise the duty of one wheel until a key is pressed, and return it. left, right: 1 for this wheel, else 0."""
        while True:
            reached = self.drive_until_key(
                f"The power of the {wheel} wheel will rise slowly: press a key as soon as it turns.",
                [WheelStep(left * duty, right * duty) for duty in RAMP])
            if not reached:
                print(f"No key was pressed below {100 * RAMP[-1]:.0f} % of full power. Try again.")
            elif choose(f"Did the {wheel} wheel turn?", YES_OR_NO):
                return round(max(reached.left, reached.right), 4)


class BaseWizard(Wizard):
    """For a board that takes the velocity of the robot, and controls the speeds of the wheels itself."""

    wiring = staticmethod(base_wiring)

    def observe_motions(self) -> List[Any]:
        """Drive ahead, then turn left; return for each 1 when the robot did so, -1 when the opposite, or None."""
        self.drive_until_key("The wheels will turn as if to drive ahead.",
                             constant_speed(TURN_SPEED, TURN_SPEED, 2 * TURN_TIME))
        ahead = choose("Which way did the wheels turn?", {**DIRECTIONS, "none": None})
        self.drive_until_key("The wheels will turn as if to turn left on the spot.",
                             constant_speed(-1, 1, 2 * TURN_TIME))
        return [ahead, choose("Which wheel turned forward?", {"right": 1, "left": -1, "none": None})]

    def tune(self) -> None:
        """Do nothing: the board takes m/s and rad/s, measures its wheels and keeps them equally fast."""


def wizard_for(board: str, **known: Any) -> Wizard:
    """Return the Wizard for a robot with this board. known: the parameters that say where it is."""
    return (BaseWizard if BOARDS[board].driver.closed_loop else Wizard)(board=board, **known)
