"""Asks how a robot is wired and how straight it drives, by short motions, each announced and stopped by any key."""

from typing import Any, List, Optional, Sequence, Tuple

from jetbot.errors import InvalidValue, JetbotError
from jetbot.robot import Robot

from .calibration import base_wiring, motor_wiring, trim
from .terminal import choose, key_pressed, number, single_keys

STEP = 0.04        # s between two calls to the robot, which feed its watchdogs
TURN_SPEED = 0.5   # fraction of full power
TURN_STEPS = 20    # 0.8 s
DRIVE_SPEED = 0.4  # fraction of full power, for the straight metre
DRIVE_STEPS = 100  # 4 s
RAMP = [step * 0.002 for step in range(300)]  # fractions of full power, to 60 %

DIRECTIONS = {"forward": 1, "backward": -1}

Speeds = Tuple[float, float]  # left, right


class Wizard:
    """Collects the ``parameters`` of one robot, whose board takes a duty for each wheel."""

    wiring = staticmethod(motor_wiring)

    def __init__(self, **known: Any):
        self.parameters = known

    def drive(self, announcement: str, speeds: Sequence[Speeds]) -> Optional[Speeds]:
        """Wait for Enter, then drive at one pair of speeds after the other, each for ``STEP`` seconds.

        Returns the speeds at which a key was pressed, or None. Raises KeyboardInterrupt for an abort key.
        """
        input(f"\n{announcement} Press Enter to start; any key stops it. ")
        with single_keys(), Robot(**self.parameters) as robot:
            for pair in speeds:
                robot.set_motors(*pair)
                robot.keep_alive()
                robot.verify()
                if key_pressed(STEP):
                    return pair
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
            self.drive(f"The {output} output will turn one wheel briefly.", [speeds] * TURN_STEPS)
            wheel = choose("Which wheel turned?", {"left": "left", "right": "right", "none": None})
            turns.append(wheel and (wheel, choose("Forward or backward?", DIRECTIONS)))
        return turns

    def straighten(self) -> None:
        """Find the smallest duty at which both wheels turn, and the alphas at which they turn equally fast."""
        input("\nPut the robot on the floor, at the start of a straight line of two metres. Press Enter to continue. ")
        self.parameters["min_duty"] = max(self.ramp("left", 1, 0), self.ramp("right", 0, 1))
        alphas = (1.0, 1.0)
        while True:
            self.parameters.update(zip(("left_motor_alpha", "right_motor_alpha"), alphas))
            speeds = [(DRIVE_SPEED, DRIVE_SPEED)] * DRIVE_STEPS
            self.drive(f"The robot will drive ahead for {DRIVE_STEPS * STEP:.0f} s.", speeds)
            drift = number("How many centimetres off the line was it after one metre? "
                           "Press Enter alone if that is straight enough.", 90) / 100
            if not drift:
                return
            alphas = trim(*alphas, drift * choose("Left or right of the line?", {"left": 1, "right": -1}))
            print("The trim is changed. Put the robot back at the start.")

    def ramp(self, wheel: str, left: int, right: int) -> float:
        """Raise the duty of one wheel until a key is pressed, and return it. left, right: 1 for this wheel, else 0."""
        while True:
            reached = self.drive(f"The power of the {wheel} wheel will rise slowly: press a key as soon as it turns.",
                                 [(left * duty, right * duty) for duty in RAMP])
            if not reached:
                print(f"No key was pressed below {100 * RAMP[-1]:.0f} % of full power. Try again.")
            elif choose(f"Did the {wheel} wheel turn?", {"yes": True, "no": False}):
                return round(max(reached), 3)


class BaseWizard(Wizard):
    """For a board that takes the velocity of the robot, and controls the speeds of the wheels itself."""

    wiring = staticmethod(base_wiring)

    def observe_motions(self) -> List[Any]:
        """Drive ahead, then turn left; return for each 1 when the robot did so, -1 when the opposite, or None."""
        self.drive("The wheels will turn as if to drive ahead.", [(TURN_SPEED, TURN_SPEED)] * 2 * TURN_STEPS)
        ahead = choose("Which way did the wheels turn?", {**DIRECTIONS, "none": None})
        self.drive("The wheels will turn as if to turn left on the spot.", [(-1, 1)] * 2 * TURN_STEPS)
        return [ahead, choose("Which wheel turned forward?", {"right": 1, "left": -1, "none": None})]

    def straighten(self) -> None:
        """Do nothing: the board measures its wheels and keeps them equally fast."""


WIZARDS = {"jetbot_pro": BaseWizard}  # for the other boards: Wizard
