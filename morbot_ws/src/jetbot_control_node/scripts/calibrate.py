#!/usr/bin/env python3
"""Asks at the terminal how a robot is wired and how straight it drives, and writes that down for the controller.

Every motion is announced and short, and any key ends it.
"""

import argparse
import os
import shlex
import sys
from pathlib import Path

from jetbot import JetbotError
from jetbot.boards import BOARDS, PORT, find_board
from jetbot.host import model, robot_bus
from jetbot.i2c import bus_name, fake_folder
from jetbot_ros.parameters import default_file
from jetbot_tools.calibration import as_yaml
from jetbot_tools.doctor import LAUNCH, check_address, check_device, check_serial
from jetbot_tools.terminal import as_options, pause
from jetbot_tools.wizard import WIZARDS, Wizard


def boards_there(bus, port):
    """The boards that may be there; those of one address cannot be told apart before a wheel turns."""
    candidates = [board for board, row in BOARDS.items() if row.address and board != "jetbot"]  # which is two of them
    checks = {board: check_address(bus, BOARDS[board].address) for board in candidates}
    if not any(check.ok for check in checks.values()):
        checks["jetbot_pro"] = check_serial(port)
    found = [board for board, check in checks.items() if check.ok]
    if not found:
        print(*dict.fromkeys(map(str, checks.values())), sep="\n")
        raise JetbotError("no motor board found", "If you know which one it is, name it with --board.")
    return found


def calibrate(boards, bus, port):
    """Go through all steps; the parameters that they have settled."""
    pause("Put the robot on a box, so that its wheels turn freely. Enter goes on, Ctrl-C ends at any time.")
    for board in boards:
        link = {"i2c_bus": bus} if BOARDS[board].address else {"port": port}
        wizard = WIZARDS.get(board, Wizard)(board, **link)
        print(f"\nTrying the board {board}.")
        if wizard.find_motors():
            break
    else:
        raise JetbotError("no wheel turned", "Is the motors' battery on? See: rosrun jetbot_control_node doctor.py")
    wizard.straighten()
    return wizard.parameters


def check_output(file):
    """Raise a JetbotError where the file cannot be written later."""
    try:
        file.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise JetbotError(f"there is no place for {file}: {error}") from None
    if not os.access(file.parent, os.W_OK) or file.exists() and not file.is_file():
        raise JetbotError(f"the file {file} cannot be written", "Name another with --output.")


def write(file, text):
    """Write the text, keep what the file held before under another name, and say how to undo it."""
    undo = ["rm", str(file)]
    new = Path(f"{file}.new")
    new.write_text(text)
    if file.exists():
        before = next(path for path in (Path(f"{file}.{number}") for number in range(1, 1000)) if not path.exists())
        file.replace(before)
        undo = ["mv", str(before), str(file)]
    new.replace(file)
    print(f"Written to {file}. To undo it: {shlex.join(undo)}")
    if file == default_file():
        print("The controller uses it from now on.")
    else:
        argument = shlex.quote(f"config:={file.absolute()}")
        print(f"To use it: {LAUNCH} {argument}")


def bus_argument(text):
    """The bus, so that it means the same from every folder: a number, or a fake bus's name in full."""
    name = bus_name(text)
    folder = fake_folder(name)
    return f"fake:{Path(folder).absolute()}" if folder else int(text)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--board", default=os.environ.get("JETBOT_BOARD") or None,
                        help=f"one of {', '.join(BOARDS)}, where it is known; otherwise it is found out")
    parser.add_argument("--i2c-bus", default=os.environ.get("JETBOT_I2C_BUS") or str(robot_bus(model()) or 1),
                        help="N, fake, or fake:FOLDER")
    parser.add_argument("--port", default=os.environ.get("JETBOT_PORT") or PORT, help="of a JetBot Pro")
    parser.add_argument("--output", type=Path, default=default_file(), help="the YAML file to write (%(default)s)")
    options = parser.parse_args(as_options(sys.argv[1:]))
    if not sys.stdin.isatty():
        raise JetbotError("calibrate.py asks questions and needs a terminal")
    if options.board:
        find_board(options.board)  # before all else, a name that is wrong
    check_output(options.output)
    bus = bus_argument(options.i2c_bus)
    boards = [options.board] if options.board else boards_there(bus, options.port)
    for check in check_device(bus_name(bus) if BOARDS[boards[0]].address else options.port):
        if not check.ok:
            print(check)
    text = as_yaml(calibrate(boards, bus, options.port))
    print(f"\n{text}")
    write(options.output, text)


if __name__ == "__main__":
    try:
        main()
    except JetbotError as error:
        sys.exit(str(error))
    except OSError as error:
        sys.exit(f"The wheels stand, but the file was not written: {error}")
    except (KeyboardInterrupt, EOFError):
        sys.exit("\nEnded; the wheels stand and nothing was written.")
