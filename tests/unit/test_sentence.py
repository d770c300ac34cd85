"""A sentence as data: what a program says in English, and what a page needs to say it in another language."""

import pytest

from jetbot.sentence import row

ROWS = {"far": "{robot} is {count} degree too far|{robot} is {count} degrees too far", "gone": "{robot} is gone"}


@pytest.mark.parametrize("code, arguments, text", [
    ("gone", {"robot": "red"}, "red is gone"), ("gone", {"robot": "{red}|"}, "{red}| is gone"),
    ("far", {"robot": "red", "count": 1}, "red is 1 degree too far"),
    ("far", {"robot": "red", "count": "1.5"}, "red is 1.5 degrees too far"),
    ("far", {"robot": "red", "count": 0}, "red is 0 degrees too far")])
def test_the_sentence_in_english(code, arguments, text):
    assert str(row(ROWS, code, **arguments)) == text


def test_its_parts_for_a_page():
    assert row(ROWS, "far", robot="red", count=2).fields() == {
        "code": "far", "arguments": {"robot": "red", "count": "2"}, "text": "red is 2 degrees too far",
        "template": ROWS["far"]}
