#!/usr/bin/env python3
"""Asks at the terminal how a robot is wired and how it drives, and writes the answers for the controller.

Every motion is announced and short, and any key stops it.
"""

import argparse
import sys
from pathlib import Path
from typing import Any, Dict, List, Optional

from jetbot import JetbotError
from jetbot.boards import BOARDS, SERIAL_BOARD, find_board
from jetbot.connection import locate, lock_board
from jetbot.host import doctor_command, model, robot_bus
from jetbot.text import printable
from jetbot_control_node.parameters import PARAMETERS, is_fake
from jetbot_tools.calibration.body import body_of
from jetbot_tools.calibration.settings import as_yaml, output_file, write_all
from jetbot_tools.calibration.wizard import Wizard, wizard_for
from jetbot_tools.doctor.computer import Check, check_users
from jetbot_tools.doctor.motor_board import check_board
from jetbot_tools.options import add_options, fake_advice, parse
from jetbot_tools.terminal import YES_OR_NO, choose


def find_boards(i2c_address: Optional[int], **place: Any) -> List[str]:
    """Return the names of the boards that answer on the i2c_bus, else on the port; raise JetbotError if none does."""
    places = {board: locate(row, **place) for board, row in BOARDS.items() if board != "jetbot"}  # two of them
    for each in dict.fromkeys(places.values()):
        checks = {board: check_board(board, i2c_address=i2c_address, **place)
                  for board in places if places[board] == each}
        boards = drivable({board: check for board, check in checks.items() if check.ok})
        if boards:
            return boards
        print(*dict.fromkeys(map(str, checks.values())), sep="\n")
    raise JetbotError("no motor board found", "If you know which one it is, name it with --board.", "i2c_bus")


def drivable(checks: Dict[str, Check]) -> List[str]:
    """Return the boards that answer for certain; without any, those of which a person says so: a servo could move."""
    conditions = dict.fromkeys(check.condition for check in checks.values())
    met = {""} if "" in conditions else {
        condition for condition in conditions if choose(f"Is it certain that {condition}?", YES_OR_NO)}
    return [board for board, check in checks.items() if check.condition in met]


def calibrate(boards: List[str], i2c_address: Optional[int], **place: Any) -> Wizard:
    """Try the boards until a wheel turns; return the wizard that found it. Raise JetbotError if none turns."""
    input("Put the robot on a box, so that its wheels turn freely. Press Enter to continue; Ctrl-C quits at any time. ")
    address = {} if i2c_address is None else {"i2c_address": i2c_address}
    for board in boards:
        row = find_board(board, i2c_address)
        with lock_board(locate(row, **place), row.address):
            wizard = wizard_for(board, **place, **address)
            print(f"\nTrying the board {board}.")
            if wizard.find_motors():
                wizard.tune()
                return wizard
    raise JetbotError("no wheel turned", f"Is the motors' battery on? Run: {doctor_command()}")


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    add_options(parser, board="those that answer are tried", i2c_bus="the one of this computer's motors",
                i2c_address="the board's own", port="")
    parser.add_argument("--output", type=Path, help="the YAML file to write (default: jetbot.yaml in ROS's home; "
                                                    "jetbot_fake.yaml for a simulated robot)")
    options = parse(parser, sys.argv[1:])
    if not sys.stdin.isatty():
        raise JetbotError("calibrate.py asks questions and needs a terminal")
    sys.stdin.reconfigure(errors="replace")  # a key may give what is no text
    if options.i2c_bus is None:
        options.board = options.board or options.port and SERIAL_BOARD
        options.i2c_bus = robot_bus(model()) or PARAMETERS["i2c_bus"].default
    place = {"i2c_bus": options.i2c_bus, "port": options.port or PARAMETERS["port"].default}
    boards = [options.board] if options.board else find_boards(options.i2c_address, **place)
    file = output_file(options.output, is_fake({"board": boards[0], **place}))
    for check in check_users(locate(find_board(boards[0]), **place)):
        if not check.ok:
            print(check)
    found = calibrate(boards, options.i2c_address, **place)
    print(f"\n{as_yaml(found.parameters)}")
    write_all(file, found.parameters, body_of(found.parameters, found.dead_band))


if __name__ == "__main__":
    try:
        main()
    except JetbotError as error:
        sys.exit(error.text(fake_advice))
    except OSError as error:
        sys.exit(printable(f"The wheels are stopped, but the file was not written: {error}"))
    except (KeyboardInterrupt, EOFError):
        sys.exit("\nCancelled: the wheels are stopped and nothing was written.")
