"""Words for people: text from outside made harmless to print, lists in one phrase, what was probably meant."""

import unicodedata
from typing import Iterable, Optional, Sequence

MAX_LENGTH = 1000  # characters; a sentence is shorter


def printable(text: object) -> str:
    """Return the text on one line: control characters are escaped as in Python, what exceeds MAX_LENGTH is cut off."""
    shown = "".join(each if each.isprintable() else ascii(each)[1:-1] for each in str(text)[:MAX_LENGTH + 1])
    return shown if len(shown) <= MAX_LENGTH else f"{shown[:MAX_LENGTH]}..."


def is_printable(text: object, longest: int) -> bool:
    """Return whether this is text without control characters, of so many characters at most.

    Browsers know newer characters than this Python, such as emoji.
    """
    return isinstance(text, str) and len(text) <= longest and all(
        each.isprintable() or unicodedata.category(each) == "Cn" for each in text)


def literal(value: object) -> str:
    """Return a value as Python writes it, on one line."""
    try:
        return printable(repr(value))
    except ValueError:  # from Python 3.11 on, of an int with more than 4,300 digits
        return "a number of more than 4,300 digits"


def enumeration(names: Sequence[str]) -> str:
    """Return one name or more in one phrase: a, b and c."""
    return " and ".join(filter(None, [", ".join(names[:-1]), names[-1]]))


def closest(name: str, names: Iterable[str]) -> Optional[str]:
    """Return the name that was probably meant, or None."""
    from difflib import get_close_matches  # here: nearly every start does without
    return next(iter(get_close_matches(name.strip("_").lower(), sorted(names), 1)), None)
