"""A person at a terminal: questions with few answers, and keys that are read at once."""

import contextlib
import select
import sys
import termios
import tty
from typing import Any, Dict, Iterator

YES_OR_NO = {"yes": True, "no": False}
ABORT_KEYS = (b"\x03", b"\x04", b"\x1a", b"\x1c", b"")  # Ctrl-C, Ctrl-D, Ctrl-Z, Ctrl-\, and a terminal that is gone


def choose(question: str, answers: Dict[str, Any], enter: str = "") -> Any:
    """Ask until one of the answers, or its beginning, is given; return its meaning.

    answers: {word: meaning}; enter: the word that Enter alone stands for, if it stands for one.
    """
    hint = f", or Enter alone for {enter}" if enter else ""
    while True:
        given = input(f"{question} [{'/'.join(answers)}{hint}] ").strip().lower() or enter
        matches = [word for word in answers if given and word.startswith(given)]
        if len(matches) == 1:
            return answers[matches[0]]
        print(f"Please answer with one of: {', '.join(answers)}")


def number(question: str, highest: float, lowest: float = 0.0) -> float:
    """Ask until a number from ``lowest`` to ``highest`` is given, with or without "cm"; Enter alone means 0."""
    while True:
        given = input(f"{question} ").lower().replace("cm", "").replace(",", ".").strip()
        with contextlib.suppress(ValueError):
            if not given or lowest <= float(given) <= highest:
                return float(given or 0)
        print(f"Please answer with a number from {lowest:g} to {highest}.")


def offset(question: str, highest: float, sides: Dict[str, int]) -> float:
    """Ask for a number and, unless it is 0, for its side; return it with that sign. sides: {word: 1 or -1}."""
    distance = number(question, highest)
    return distance and distance * choose(f"{' or '.join(sides).capitalize()}?", sides)


@contextlib.contextmanager
def single_keys() -> Iterator[None]:
    """Deliver each key at once, Ctrl-C and Ctrl-Z too, and show none, inside the with block."""
    before = termios.tcgetattr(sys.stdin)
    try:
        tty.setraw(sys.stdin)
        yield
    finally:
        with contextlib.suppress(termios.error):  # the terminal may be gone
            termios.tcsetattr(sys.stdin, termios.TCSAFLUSH, before)


def key_pressed(timeout: float) -> bool:
    """Return whether a key is pressed within ``timeout`` seconds; raise KeyboardInterrupt for an abort key."""
    if not select.select([sys.stdin], [], [], timeout)[0]:
        return False
    with contextlib.suppress(OSError):  # the terminal is gone
        if sys.stdin.buffer.raw.read(1) not in ABORT_KEYS:
            return True
    raise KeyboardInterrupt
