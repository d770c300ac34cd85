"""Asks how a robot is wired and how straight it drives: short motions, each announced and ended by any key."""

from jetbot.errors import InvalidValue, JetbotError
from jetbot.robot import Robot

from .calibration import orientation, orientation_of_both, trim
from .terminal import choose, hold, move, number, pause

TURN = 0.5         # part of full power
TURN_TIME = 0.8    # seconds
DRIVE = 0.4        # part of full power, for the straight metre
DRIVE_TIME = 4.0   # seconds
RAMP_STEP = 0.002  # part of full power, every 0.04 s
RAMP_END = 0.6
FAILSAFE = 0.5     # seconds, for a board with a timer

WHEELS = {"left": "left", "right": "right", "none": None}
WAYS = {"forward": 1, "backward": -1}
ANSWERS = {"yes": True, "no": False}


class Wizard:
    """Gathers the ``parameters`` of one robot, whose board drives each wheel by itself.

    board: its name in ``boards.BOARDS``; link: its i2c_bus or its port, by that name.
    """

    def __init__(self, board, **link):
        self.parameters = {"board": board, **link}

    def robot(self):
        """The robot as far as it is known."""
        return Robot(**self.parameters, failsafe=FAILSAFE)

    def find_motors(self):
        """Which wheel turns which way at each output; whether any turned at all."""
        while True:
            with self.robot() as robot:
                seen = [self.turn(robot, "left", TURN, 0), self.turn(robot, "right", 0, TURN)]
            if not all(seen):
                return self.give_up(seen)
            try:
                self.parameters.update(orientation(*seen))
                return True
            except InvalidValue as error:
                print(error)

    def turn(self, robot, output, *speeds):
        """Turn one output forward; (wheel, way) as it was seen, or None when nothing turned."""
        pause(f"\nThe {output} output will turn one wheel for a moment. Enter starts it, any key stops it.")
        move(robot, hold(*speeds, TURN_TIME))
        wheel = choose("Which wheel turned?", WHEELS)
        return wheel and (wheel, choose("Forward or backward?", WAYS))

    def give_up(self, seen):
        """False where nothing turned, so that it may be another board; a JetbotError where something did."""
        if any(seen):
            raise JetbotError("only one motor turns", "Look at its plug and its wires, and start anew.")
        return False

    def straighten(self):
        """On the floor: the parameters with which both wheels turn, and alike."""
        pause("\nNow put it on the floor, at the start of a straight line of two metres. Enter goes on.")
        self.find_min_duty()
        self.find_trim()

    def find_min_duty(self):
        """The least duty at which both wheels turn."""
        self.parameters["min_duty"] = max(self.ramp("left", 1, 0), self.ramp("right", 0, 1))

    def ramp(self, wheel, left, right):
        """Give one wheel more and more power until a key is pressed; the duty at which it turned."""
        while True:
            pause(f"\nThe {wheel} wheel gets power very slowly. Enter starts it; press any key as soon as it turns.")
            duties = [i * RAMP_STEP for i in range(int(RAMP_END / RAMP_STEP))]
            with self.robot() as robot:
                reached = move(robot, ((left * duty, right * duty) for duty in duties))
            if not reached:
                print(f"No key was pressed before {100 * RAMP_END:.0f} % of full power. Once more:")
            elif choose(f"Did the {wheel} wheel turn?", ANSWERS):
                return round(max(reached), 3)

    def find_trim(self):
        """The alphas with which it drives straight."""
        alphas, straight = (1.0, 1.0), False
        while not straight:
            self.parameters.update(zip(("left_motor_alpha", "right_motor_alpha"), alphas))
            pause(f"\nIt will drive ahead for {DRIVE_TIME:.0f} s. Enter starts it, any key stops it.")
            with self.robot() as robot:
                move(robot, hold(DRIVE, DRIVE, DRIVE_TIME))
            drift = number("How many centimetres beside the line was it after one metre? "
                           "Enter alone if that is straight enough.", 0, 90) / 100
            straight = drift == 0
            if not straight:
                side = choose("To the left or to the right of the line?", {"left": 1, "right": -1})
                alphas = trim(*alphas, side * drift)
                print("Noted. Put it back to the start, and see whether it is straight now.")


class JetBotProWizard(Wizard):
    """For the board that is told how fast the robot drives and turns, and keeps its wheels at these speeds itself."""

    def find_motors(self):
        """Whether it drives ahead and turns left when it should; whether any wheel turned at all."""
        with self.robot() as robot:
            ahead = self.watch(robot, "drive ahead", (TURN, TURN), "Which way did the wheels turn?", WAYS)
            turn = self.watch(robot, "turn on the spot, to the left", (-1, 1), "Which wheel turned forward?",
                              {"right": 1, "left": -1})
        if not (ahead and turn):
            return self.give_up((ahead, turn))
        self.parameters.update(orientation_of_both(ahead, turn))
        return True

    def watch(self, robot, what, speeds, question, answers):
        """Drive for a moment; what was seen, None when nothing turned."""
        pause(f"\nThe wheels will turn as if to {what}, for a moment. Enter starts it, any key stops it.")
        move(robot, hold(*speeds, 2 * TURN_TIME))
        return choose(question, {**answers, "none": None})

    def straighten(self):
        """Nothing to do: the board measures its wheels, and keeps them at the speeds that it was told."""


WIZARDS = {"jetbot_pro": JetBotProWizard}  # for the other boards: Wizard
