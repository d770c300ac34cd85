#!/usr/bin/env python3
"""Asks at the terminal how a robot is wired and how straight it drives, and writes that down for the controller.

Every motion is announced and short, and any key ends it.
"""

import argparse
import os
import sys
from pathlib import Path

from jetbot import InvalidValue, JetbotError, Robot
from jetbot.calibration import as_yaml, orientation, trim
from jetbot.doctor import ADDRESSES, boards_at, check_users
from jetbot.i2c import I2CDevice
from jetbot.parameters import default_file
from jetbot.terminal import choose, hold, move, number

TURN = 0.5         # part of full power
TURN_TIME = 0.8    # seconds
DRIVE = 0.4        # part of full power, for the straight metre
DRIVE_TIME = 4.0   # seconds
RAMP_STEP = 0.002  # part of full power, every 0.04 s
RAMP_END = 0.6


class Wizard:
    """Goes through the steps, and gathers the parameters that they settle."""

    def __init__(self, **link):
        self.parameters = link

    def robot(self, **options):
        """The robot as far as it is known; with options for what is being tried."""
        return Robot(**{**self.parameters, **options})

    def run(self, boards):
        input("Put the robot on a box, so that its wheels turn freely. Enter goes on, Ctrl-C ends at any time. ")
        self.find_motors(boards)
        input("\nNow put it on the floor, at the start of a straight line of two metres. Enter goes on. ")
        self.find_min_duty()
        self.find_trim()

    def find_motors(self, boards):
        """Which board it is, and which wheel turns which way at each output."""
        for board in boards:
            print(f"\nTrying the board {board}.")
            try:
                with self.robot(board=board) as robot:
                    seen = [self.turn(robot, output) for output in ("left", "right")]
                if all(seen):
                    self.parameters.update(orientation(*seen), board=board)
                    return None
            except InvalidValue as error:
                print(error)
                return self.find_motors(boards)
        raise JetbotError("no wheel turned on any board", "Is the motors' battery on? Is the bus the right one? "
                          "See: rosrun jetbot_control_node doctor.py")

    def turn(self, robot, output):
        """Turn one output forward; (wheel, way) as it was seen, or None when nothing turned."""
        input(f"\nThe {output} output will turn one wheel for a moment. Enter starts it, any key stops it. ")
        move(robot, hold(*((TURN, 0) if output == "left" else (0, TURN)), TURN_TIME))
        wheel = choose("Which wheel turned: left, right or none?", {"l": "left", "r": "right", "n": None})
        return wheel and (wheel, choose("Forward or backward?", {"f": 1, "b": -1}))

    def find_trim(self):
        """The alphas with which it drives straight."""
        alphas = 1.0, 1.0
        while True:
            self.parameters.update(zip(("left_motor_alpha", "right_motor_alpha"), alphas))
            input(f"\nIt will drive ahead for {DRIVE_TIME:.0f} s. Enter starts it, any key stops it. ")
            with self.robot() as robot:
                move(robot, hold(DRIVE, DRIVE, DRIVE_TIME))
            drift = number("How many centimetres beside the line was it after one metre? 0 if none.", 0, 90) / 100
            if drift == 0:
                return
            side = choose("To the left or to the right of the line?", {"l": 1, "r": -1})
            alphas = trim(*alphas, side * drift)
            print("Noted. Put it back to the start, and see whether it is straight now.")

    def find_min_duty(self):
        """The least duty at which both wheels turn."""
        self.parameters["min_duty"] = max(self.ramp(wheel) for wheel in ("left", "right"))

    def ramp(self, wheel):
        """Give one wheel more and more power until a key is pressed; the duty then, 0 when none was."""
        input(f"\nThe {wheel} wheel will get power very slowly. Enter starts it; press any key as soon as it turns. ")
        rising = (i * RAMP_STEP for i in range(int(RAMP_END / RAMP_STEP)))
        speeds = ((duty, 0.0) if wheel == "left" else (0.0, duty) for duty in rising)
        with self.robot(left_motor_alpha=1.0, right_motor_alpha=1.0) as robot:
            reached, pressed = move(robot, speeds)
        return round(max(reached), 3) if pressed else 0.0


def candidates(i2c_bus):
    """The I2C boards to try: those whose address answers on the bus."""
    for address in reversed(ADDRESSES):
        try:
            I2CDevice(i2c_bus, address).read(0)
        except JetbotError:
            continue
        return [board for board in boards_at(address) if board != "jetbot"]  # which drives several layouts at once
    return []


def write(file, parameters):
    """Write the parameters, and say how to undo it."""
    file.parent.mkdir(parents=True, exist_ok=True)
    undo = f"rm {file}"
    if file.exists():
        undo = f"mv {file}.before {file}"
        file.replace(f"{file}.before")
    file.write_text(as_yaml(parameters))
    print(f"\n{file.read_text()}\nWritten to {file}. To undo it: {undo}")
    if file == default_file():
        print("The controller uses it from now on.")
    else:
        print(f"To use it: roslaunch jetbot_control_node jetbot_controller.launch config:={file.absolute()}")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--i2c-bus", default=os.environ.get("JETBOT_I2C_BUS", "1"), help="N, fake, or fake:FOLDER")
    parser.add_argument("--port", default=os.environ.get("JETBOT_PORT", "/dev/ttyACM0"), help="of a JetBot Pro")
    parser.add_argument("--output", type=Path, default=default_file(), help="the YAML file to write (%(default)s)")
    options = parser.parse_args()
    if not sys.stdin.isatty():
        raise JetbotError("calibrate.py asks questions and needs a terminal")
    users = check_users(Path(f"/dev/i2c-{options.i2c_bus}"))
    if not users.ok:
        raise JetbotError(f"{users.name} is {users.finding}", users.advice)
    boards = candidates(options.i2c_bus)
    wizard = Wizard(i2c_bus=options.i2c_bus) if boards else Wizard(port=options.port)
    wizard.run(boards or ["jetbot_pro"])
    write(options.output, wizard.parameters)


if __name__ == "__main__":
    try:
        main()
    except JetbotError as error:
        sys.exit(str(error))
    except OSError as error:
        sys.exit(f"The wheels stand, but the file was not written: {error}")
    except (KeyboardInterrupt, EOFError):
        sys.exit("\nEnded; the wheels stand and nothing was written.")
