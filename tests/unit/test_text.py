"""Text from outside cannot change the terminal that it is printed on."""

import pytest

from jetbot import JetbotError
from jetbot.text import MAX_LENGTH, literal, printable
from jetbot_tools.doctor.computer import Check


@pytest.mark.parametrize("text, shown", [
    ("Läuft, 100 %", "Läuft, 100 %"), ("👩‍👧 می‌خواهم", "👩‍👧 می‌خواهم"),
    ("\x1b[2J", r"\x1b[2J"), ("a\r\nb", r"a\r\nb"), ("\x9b1m", r"\x9b1m"),
    ("\u202eevil", r"\u202eevil"), ("\udcff", r"\udcff"), ("x" * 10**6, "x" * MAX_LENGTH + "...")],
    ids=lambda text: ascii(text)[:20])
def test_only_printable_characters_on_one_line(text, shown):
    assert printable(text) == shown


def test_a_value_as_python_writes_it():
    assert literal("\x1b") == r"'\x1b'" and literal([1]) == "[1]" and len(literal(16**5000)) < 2 * MAX_LENGTH


def test_errors_and_checks_are_printable():
    assert str(JetbotError("no \x1b[2J", "ask \x07")) == r"No \x1b[2J. ask \x07"
    assert str(Check("\x1b", True, "\n", "\r.")) == r"ok  \x1b: \n. \r."
