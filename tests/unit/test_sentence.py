"""A sentence as data: what a program says in English, and what a page needs to say it in another language."""

import pytest
from languages import templates

from jetbot.sentence import Sentence, names_in, read_row, row

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


@pytest.mark.parametrize("code, values, arguments", [
    ("gone", {"robot": "red", "name": "Ada"}, {"robot": "red"}), ("gone", {"name": "Ada"}, None), ("new", {}, None)],
    ids=["among other values", "without its argument", "of a newer program"])
def test_what_another_program_says_by_its_code(code, values, arguments):
    sentence = read_row(ROWS, code, values)
    assert (sentence and sentence.arguments) == arguments


@pytest.mark.parametrize("template", templates())
def test_each_template_of_a_page_is_whole(template):
    forms = template.split("|")
    assert len(forms) <= 2 and all(names_in(form) == names_in(forms[0]) for form in forms)
    assert len(forms) == 1 or "count" in names_in(template)
    for count in "1", "2":
        text = str(Sentence("", template, {**dict.fromkeys(names_in(template), "7"), "count": count}))
        assert text.strip() == text and not set("{}|") & set(text)
