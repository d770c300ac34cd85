"""A person at a terminal: questions with few answers, and motions that any key stops."""

import contextlib
import re
import select
import sys
import termios
import time
import tty
from typing import Any, Dict, Iterable, Iterator, Optional, Tuple

from jetbot.robot import Robot

STEP = 0.04  # seconds between two calls to the robot, which feed its watchdog
ABORT_KEYS = (b"\x03", b"\x04", b"\x1a", b"\x1c", b"")  # Ctrl-C, Ctrl-D, Ctrl-Z, Ctrl-\, and a terminal that is gone
Speeds = Tuple[float, float]  # left, right


def choose(question: str, answers: Dict[str, Any]) -> Any:
    """Ask until one of the answers, or its beginning, is given; return its meaning. answers: {word: meaning}."""
    while True:
        given = input(f"{question} [{'/'.join(answers)}] ").strip().lower()
        matches = [word for word in answers if given and word.startswith(given)]
        if len(matches) == 1:
            return answers[matches[0]]
        print(f"Please answer with one of: {', '.join(answers)}")


def number(question: str, lowest: float, highest: float) -> float:
    """Ask until a number in this range is given, with or without "cm"; Enter alone means 0."""
    while True:
        given = re.fullmatch(r"([\d.]*)\s*(cm)?", input(f"{question} ").strip().lower().replace(",", "."))
        with contextlib.suppress(TypeError, ValueError):  # no match; no number
            if lowest <= float(given[1] or 0) <= highest:
                return float(given[1] or 0)
        print(f"Please answer with a number from {lowest} to {highest}.")


@contextlib.contextmanager
def single_keys() -> Iterator[None]:
    """Deliver each key at once, Ctrl-C and Ctrl-Z too, and show none, inside the with block."""
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


def drive_until_key(robot: Robot, speeds: Iterable[Speeds]) -> Optional[Speeds]:
    """Drive at one pair of speeds after the other, each for ``STEP`` seconds, until a key is pressed; then stop.

    Returns the speeds at which the key was pressed, None where none was. Raises KeyboardInterrupt for an abort key.
    """
    pressed = None
    with single_keys():
        try:
            for pair in speeds:
                robot.set_motors(*pair)
                robot.keep_alive()
                robot.verify()
                if select.select([sys.stdin], [], [], STEP)[0]:
                    pressed = pair
                    break
        finally:
            robot.stop()
        if pressed and read_key() in ABORT_KEYS:
            raise KeyboardInterrupt
    return pressed


def read_key() -> bytes:
    """Return the key that was pressed; b"" from a terminal that is gone."""
    with contextlib.suppress(OSError):
        return sys.stdin.buffer.raw.read(1)
    return b""


def constant_speed(left: float, right: float, seconds: float) -> Iterator[Speeds]:
    """Yield the same speeds for this time, for ``drive_until_key``."""
    end = time.monotonic() + seconds
    while time.monotonic() < end:
        yield left, right
