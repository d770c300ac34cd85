"""Both pages are in German, Spanish, French, Italian and Japanese: no sentence is forgotten, and no name is lost."""

import re
from unicodedata import east_asian_width

import pytest
from languages import CODES, WWW, keys, messages, read

NAMES = re.compile(r"\{\w+\}|%\d")
LABELS = {"Stop": "Stop {robot}", "Release": "Release {robot}", "Undo": "Undo: {name}", "Copy": "Copy: {name}",
          "Delete": "Delete: {name}"}  # the text of a button, and its name for a screen reader


@pytest.mark.parametrize("code", CODES)
def test_each_language_can_be_chosen(code):
    rows = (WWW / "language.js").read_text().partition("LANGUAGES")[2].partition(";")[0]
    assert re.search(rf"\b{code}\b", rows), f'write into LANGUAGES of www/language.js: {code}: "its own name"'


@pytest.mark.parametrize("code", CODES)
def test_each_sentence_of_the_pages_is_translated_and_no_other(code):
    missing, unused = keys(code) - read(code).keys(), read(code).keys() - keys(code)
    assert not missing, f"write into www/languages/{code}.json: {sorted(missing)}"
    assert not unused, f"delete from www/languages/{code}.json: {sorted(unused)}"


@pytest.mark.parametrize("code", CODES)
def test_a_translation_names_what_the_english_names_in_each_of_its_forms(code):
    assert {english: translation for english, translation in read(code).items() for form in translation.split("|")
            if set(NAMES.findall(form)) != set(NAMES.findall(english.split("|")[-1]))} == {}


@pytest.mark.parametrize("code", CODES)
def test_who_says_what_is_on_a_button_presses_it(code):
    words = read(code)
    assert {name: words[name] for text, name in LABELS.items() if words[text] not in words[name]} == {}


@pytest.mark.parametrize("code", CODES)
def test_no_translation_has_two_forms_where_nothing_is_counted(code):
    assert not [english for english, translation in read(code).items()
                if "|" in translation and "{count}" not in english]


@pytest.mark.parametrize("code", CODES)
@pytest.mark.parametrize("english, width", [("name", 6), ("my program", 10)])  # letters
def test_what_a_narrow_field_shows_is_short(code, english, width):
    assert sum(2 if east_asian_width(each) == "W" else 1 for each in read(code)[english]) <= width


@pytest.mark.parametrize("code", CODES)
def test_a_sentence_says_true_and_false_as_the_blocks_do(code):
    for word in ("true", "false"):
        assert messages(code)[f"LOGIC_BOOLEAN_{word.upper()}"] in read(code)[f"“{word}”"]
