"""A person at a terminal: questions with few answers, and motions that any key ends."""

import contextlib
import select
import sys
import termios
import time
import tty

STEP = 0.04  # seconds between two signs of life to the board
ENDING = (b"\x03", b"\x04", b"\x1a", b"\x1c", b"")  # Ctrl-C, Ctrl-D, Ctrl-Z, Ctrl-\, and the terminal's end


def choose(question, answers):
    """Ask until one of the answers, a dict of key: meaning, is given; return its meaning."""
    while True:
        answer = input(f"{question} [{'/'.join(answers)}] ").strip().lower()
        if answer in answers:
            return answers[answer]
        print(f"Please answer with one of: {', '.join(answers)}")


def number(question, least, most):
    """Ask until a number from least to most is given."""
    while True:
        answer = input(f"{question} ").strip().replace(",", ".")
        with contextlib.suppress(ValueError):
            if least <= float(answer) <= most:
                return float(answer)
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

    Returns the speeds at which it ended, and whether a key ended it. The robot stands then, whatever happened.
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
    return now, pressed


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
