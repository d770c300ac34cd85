"""A sentence as data: what a program says in English, and what a page needs to say it in another language."""

import json

import pytest
from languages import templates

from jetbot.sentence import MAX_JSON, MAX_SENTENCES, MAX_TEXT, Sentence, dump, load, names_in, read_row, row

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


def test_an_argument_may_be_a_sentence_itself():
    said = row(ROWS, "gone", robot=row(ROWS, "gone", robot="red"))
    assert str(said) == "red is gone is gone"
    assert said.fields()["arguments"] == {"robot": {
        "code": "gone", "arguments": {"robot": "red"}, "text": "red is gone", "template": "{robot} is gone"}}


FAR = row(ROWS, "far", robot="red", count=2)


def test_what_one_program_dumps_another_one_loads():
    for sentences in (), (FAR,), (FAR, row(ROWS, "gone", robot="Ömer's")):
        assert load(dump(sentences)) == sentences


@pytest.mark.parametrize("text", [
    "", "x", "7", "null", "{}", "[" * MAX_JSON, "[" * 100000, "1" * 100000, "[7]", "[[]]", "[{}]",
    '[{"code": "", "template": ""}]', dump([Sentence("", "")] * (MAX_SENTENCES + 1)),
    dump([Sentence("", "x" * MAX_TEXT)] * MAX_SENTENCES),
    *(json.dumps([{**FAR._asdict(), **changes}]) for changes in (
        {"more": ""}, {"code": 7}, {"code": None}, {"template": "\u202e"}, {"template": "x" * (MAX_TEXT + 1)},
        {"template": ["x"]}, {"arguments": []}, {"arguments": {"count": 3}}, {"arguments": {"count": "\n"}},
        {"arguments": {"\n": "3"}}, {"arguments": {"count": FAR._asdict()}}))], ids=lambda text: text[:40])
def test_nothing_else_that_a_program_may_send_is_loaded(text):
    assert load(text) is None


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
