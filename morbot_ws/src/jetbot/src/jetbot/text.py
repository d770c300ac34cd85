"""Words for people: text from outside made harmless to print, lists in one phrase, what was probably meant."""

import re
from typing import Iterable, Optional, Sequence

MAX_LENGTH = 1000  # characters; a sentence is shorter
# Control characters, ends of lines, what reverses the text around it, and surrogates; as in the page's storage.js
HARMFUL = re.compile("[\0-\x1f\x7f-\x9f\u2028-\u202e\u2066-\u2069\ud800-\udfff]")


def printable(text: object) -> str:
    """Return the text on one line: HARMFUL characters are escaped as in Python, what exceeds MAX_LENGTH is cut off."""
    shown = HARMFUL.sub(lambda found: ascii(found[0])[1:-1], str(text)[:MAX_LENGTH + 1])
    return shown if len(shown) <= MAX_LENGTH else f"{shown[:MAX_LENGTH]}..."


def is_printable(text: object, longest: int) -> bool:
    """Return whether this is text without HARMFUL characters, of so many characters at most."""
    return isinstance(text, str) and len(text) <= longest and not HARMFUL.search(text)


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
