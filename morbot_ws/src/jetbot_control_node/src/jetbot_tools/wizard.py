"""Asks how a robot is wired and how straight it drives, by short motions, each announced and stopped by any key."""

from typing import Any, Iterable, Optional

from jetbot.errors import InvalidValue, JetbotError
from jetbot.robot import Robot

from .calibration import Turn, base_wiring, motor_wiring, trim
from .terminal import Speeds, choose, constant_speed, drive_until_key, number

TURN = 0.5         # part of full power
TURN_TIME = 0.8    # seconds
DRIVE = 0.4        # part of full power, for the straight metre
DRIVE_TIME = 4.0   # seconds
RAMP_STEP = 0.002  # part of full power, every 0.04 s
RAMP_END = 0.6

WHEELS = {"left": "left", "right": "right", "none": None}
DIRECTIONS = {"forward": 1, "backward": -1}


class Wizard:
    """Collects the ``parameters`` of one robot, whose board drives each wheel by itself."""

    def __init__(self, **known: Any):
        self.parameters = known

    def drive(self, announcement: str, speeds: Iterable[Speeds]) -> Optional[Speeds]:
        """Wait for Enter, then drive; return the speeds at which a key was pressed, None where none was."""
        input(f"\n{announcement} Press Enter to start; any key stops it. ")
        with Robot(**self.parameters) as robot:
            return drive_until_key(robot, speeds)

    def find_motors(self) -> bool:
        """Find which output turns which wheel which way; return whether any wheel turned."""
        while True:
            turns = [self.turn("left", TURN, 0), self.turn("right", 0, TURN)]
            if not both_turned(*turns):
                return False
            try:
                self.parameters.update(motor_wiring(*turns))
                return True
            except InvalidValue as error:
                print(error)

    def turn(self, output: str, left: float, right: float) -> Optional[Turn]:
        """Drive one output forward; return which wheel turned which way, or None."""
        self.drive(f"The {output} output will turn one wheel briefly.", constant_speed(left, right, TURN_TIME))
        wheel = choose("Which wheel turned?", WHEELS)
        return wheel and (wheel, choose("Forward or backward?", DIRECTIONS))

    def straighten(self) -> None:
        """Find the parameters with which both wheels turn, and turn equally fast."""
        input("\nPut the robot on the floor, at the start of a straight line of two metres. Press Enter to continue. ")
        self.parameters["min_duty"] = max(self.ramp("left", 1, 0), self.ramp("right", 0, 1))
        self.find_trim()

    def ramp(self, wheel: str, left: int, right: int) -> float:
        """Raise the power of one wheel, whose factor is 1, until a key is pressed; return its duty then."""
        while True:
            duties = [step * RAMP_STEP for step in range(round(RAMP_END / RAMP_STEP))]
            reached = self.drive(f"The power of the {wheel} wheel will rise slowly: press a key as soon as it turns.",
                                 ((left * duty, right * duty) for duty in duties))
            if not reached:
                print(f"No key was pressed below {100 * RAMP_END:.0f} % of full power. Try again.")
            elif choose(f"Did the {wheel} wheel turn?", {"yes": True, "no": False}):
                return round(max(reached), 3)

    def find_trim(self) -> None:
        """Find the alphas with which the robot drives straight."""
        alphas = (1.0, 1.0)
        while True:
            self.parameters.update(zip(("left_motor_alpha", "right_motor_alpha"), alphas))
            self.drive(f"The robot will drive ahead for {DRIVE_TIME:.0f} s.", constant_speed(DRIVE, DRIVE, DRIVE_TIME))
            drift = number("How many centimetres off the line was it after one metre? "
                           "Press Enter alone if that is straight enough.", 0, 90) / 100
            if not drift:
                return
            alphas = trim(*alphas, drift * choose("Left or right of the line?", {"left": 1, "right": -1}))
            print("The trim is changed. Put the robot back at the start.")


class BaseWizard(Wizard):
    """For a board that takes the speeds of the whole robot, and controls those of the wheels itself."""

    def find_motors(self) -> bool:
        """Find whether the robot drives ahead and turns left as it should; return whether any wheel turned."""
        self.drive("The wheels will turn as if to drive ahead.", constant_speed(TURN, TURN, 2 * TURN_TIME))
        ahead = choose("Which way did the wheels turn?", {**DIRECTIONS, "none": None})
        self.drive("The wheels will turn as if to turn left on the spot.", constant_speed(-1, 1, 2 * TURN_TIME))
        left_turn = choose("Which wheel turned forward?", {"right": 1, "left": -1, "none": None})
        if not both_turned(ahead, left_turn):
            return False
        self.parameters.update(base_wiring(ahead, left_turn))
        return True

    def straighten(self) -> None:
        """Do nothing: the board measures its wheels and keeps them equally fast."""


WIZARDS = {"jetbot_pro": BaseWizard}  # for the other boards: Wizard


def both_turned(*seen: Any) -> bool:
    """Return whether something turned in both motions; raise JetbotError where it did in one of them."""
    if any(seen) and not all(seen):
        raise JetbotError("only one motor turns", "Check the plug and the wires of the other one, and start again.")
    return all(seen)
