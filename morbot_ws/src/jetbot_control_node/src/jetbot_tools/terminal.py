"""A person at a terminal: questions with few answers, and motions that any key ends."""

import contextlib
import re
import select
import sys
import termios
import time
import tty

STEP = 0.04  # seconds between two signs of life to the board
ENDING = (b"\x03", b"\x04", b"\x1a", b"\x1c", b"")  # Ctrl-C, Ctrl-D, Ctrl-Z, Ctrl-\, and the terminal's end


def as_options(arguments):
    """Command line arguments, where i2c_bus:=7, as ROS writes it, means --i2c-bus=7."""
    return [re.sub(r"^(\w+):=", lambda name: f"--{name[1].replace('_', '-')}=", argument) for argument in arguments]


def pause(announcement):
    """Tell something, and wait for Enter."""
    input(f"{announcement} ")


def choose(question, answers):
    """Ask until one of the answers, a dict of word: meaning, is given, or its beginning; return its meaning."""
    while True:
        given = input(f"{question} [{'/'.join(answers)}] ").strip().lower()
        meant = [word for word in answers if given and word.startswith(given)]
        if len(meant) == 1:
            return answers[meant[0]]
        print(f"Please answer with one of: {', '.join(answers)}")


def number(question, least, most):
    """Ask until a number from least to most is given, with or without a unit; Enter alone means 0."""
    while True:
        given = re.fullmatch(r"([\d.]*)\s*(cm)?", input(f"{question} ").strip().lower().replace(",", "."))
        with contextlib.suppress(TypeError, ValueError):  # no match; no number
            if least <= float(given[1] or 0) <= most:
                return float(given[1] or 0)
        print(f"Please answer with a number from {least} to {most}.")


@contextlib.contextmanager
def single_keys():
    """The terminal gives every key at once, Ctrl-C and Ctrl-Z too, and shows none."""
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setcbreak(sys.stdin)
        mode = termios.tcgetattr(sys.stdin)
        mode[3] &= ~termios.ISIG
        termios.tcsetattr(sys.stdin, termios.TCSANOW, mode)
        yield
    finally:
        with contextlib.suppress(termios.error):  # the terminal may be gone
            termios.tcsetattr(sys.stdin, termios.TCSAFLUSH, before)


def move(robot, speeds):
    """Drive through speeds, an iterable of (left, right), one every ``STEP`` seconds, until a key is pressed.

    Returns the speeds at which a key ended it, else None. The robot stands then, whatever happened.
    """
    now = (0.0, 0.0)
    pressed = False
    with single_keys():
        try:
            for now in speeds:
                robot.set_motors(*now)
                robot.refresh()
                robot.heartbeat()
                pressed = bool(select.select([sys.stdin], [], [], STEP)[0])
                if pressed:
                    break
        finally:
            robot.stop()
        if pressed and read_key() in ENDING:
            raise KeyboardInterrupt
    return now if pressed else None


def read_key():
    """The key that was pressed; b"" from a terminal that is gone."""
    with contextlib.suppress(OSError):
        return sys.stdin.buffer.raw.read(1)
    return b""


def hold(left, right, seconds):
    """The speeds for ``move`` that keep both wheels turning alike."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        yield left, right
