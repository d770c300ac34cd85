"""The handouts are made from the lessons: one for each, with its title, its commands and its questions."""

import runpy
import xml.etree.ElementTree as ET

import pytest

from conftest import ROOT
from driving_tasks.scoring.tasks import TASKS

LESSONS = {page.stem: page.read_text() for page in sorted((ROOT / "docs/lessons").glob("[0-9pt]*.md"))}


@pytest.fixture(scope="module")
def handouts(tmp_path_factory):
    file = tmp_path_factory.mktemp("handouts") / "handouts.html"
    runpy.run_path(str(ROOT / "docs/handouts.py"))["main"](str(file))
    body = file.read_text().partition("<body>")[2].partition("</body>")[0]
    return {section.get("id"): section for section in ET.fromstring(f"<body>{body}</body>")}


def text_of(element):
    return " ".join("".join(element.itertext()).split())


def test_there_is_one_for_each_lesson_and_one_for_the_scores_of_all_tasks(handouts):
    assert set(handouts) == {*LESSONS, "tasks"}
    assert {text_of(code) for code in handouts["tasks"].iter("code")} == set(TASKS)


@pytest.mark.parametrize("lesson", LESSONS)
def test_it_has_the_lessons_title_and_commands_and_a_question(handouts, lesson):
    assert LESSONS[lesson].startswith(f"# {text_of(handouts[lesson].find('.//h1'))}\n")
    commands = [text_of(row[1][0]) for row in handouts[lesson].iter("tr") if row[1].find("code") is not None]
    assert all(command in LESSONS[lesson] for command in commands)
    assert commands or lesson in ("phone", "tablet")
    assert handouts[lesson].find(".//hr") is not None


def test_an_answer_is_on_no_handout(handouts):
    assert "Without a master, nodes cannot find each other" not in text_of(handouts["2_run"])
