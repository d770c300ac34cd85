"""The handouts are made from the lessons: one for each, with its title, its commands and its questions.

Those of the lessons that are in another language are in that language, and ask the same.
"""

import re
import runpy
import xml.etree.ElementTree as ET

import pytest

from conftest import ROOT
from driving_tasks.scoring.tasks import TASKS

FOLDER = ROOT / "docs/lessons"
LESSONS = {page.stem: page.read_text() for page in sorted(FOLDER.glob("[0-9pt]*.md"))}


@pytest.fixture(scope="module")
def written(tmp_path_factory):
    """A function that writes the handouts in a language, and returns the language of the page and its sections."""
    def write(language):
        file = tmp_path_factory.mktemp("handouts") / "handouts.html"
        runpy.run_path(str(ROOT / "docs/handouts.py"))["main"](str(file), language)
        page = ET.fromstring(re.sub(r"^<!DOCTYPE html>\n", "", file.read_text()))
        return page.get("lang"), {section.get("id"): section for section in page.find("body")}
    return write


@pytest.fixture(scope="module")
def handouts(written):
    return written("en")[1]


def text_of(element):
    return " ".join("".join(element.itertext()).split())


def said(element):
    """Return the text of an element, but what is code."""
    parts = [] if element.tag == "code" else [element.text, *(f"{said(each)}{each.tail or ''}" for each in element)]
    return " ".join("".join(part or "" for part in parts).split())


def test_there_is_one_for_each_lesson_and_one_for_the_scores_of_all_tasks(handouts):
    assert set(handouts) == {*LESSONS, "tasks"}
    assert {text_of(code) for code in handouts["tasks"].iter("code")} == set(TASKS)


@pytest.mark.parametrize("lesson", LESSONS)
def test_it_has_the_lessons_title_and_commands_and_a_question(handouts, lesson):
    assert LESSONS[lesson].startswith(f"# {text_of(handouts[lesson].find('.//h1'))}\n")
    commands = [text_of(row[1][0]) for row in handouts[lesson].iter("tr") if row[1].find("code") is not None]
    assert all(command in LESSONS[lesson] for command in commands)
    assert commands or lesson in ("phone", "tablet", "python_tablet")
    assert handouts[lesson].find(".//hr") is not None


def test_an_answer_is_on_no_handout(handouts):
    assert "Without a master, nodes cannot find each other" not in text_of(handouts["2_run"])


@pytest.mark.parametrize("language", ["de", "es"])
def test_those_in_another_language_ask_the_same_in_its_words(written, handouts, language):
    lang, theirs = written(language)
    assert lang == language
    assert set(theirs) == {page.stem for page in (FOLDER / language).glob("*.md")} != set()
    for lesson, section in theirs.items():
        assert (FOLDER / f"{language}/{lesson}.md").read_text().startswith(f"# {text_of(section.find('.//h1'))}\n")
        assert [each.tag for each in section.iter()] == [each.tag for each in handouts[lesson].iter()]
        english = {said(each) for each in handouts[lesson].iter() if re.search("[a-z]{4}", said(each))}
        assert not english & {said(each) for each in section.iter()}
