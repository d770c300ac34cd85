"""The handouts: one for each lesson, with its commands; nothing that a browser would have to load."""

import re
import xml.etree.ElementTree as ET

import pytest

from conftest import ROOT
from driving_tasks.tasks import TASKS

SOURCE = (ROOT / "docs/handouts.html").read_text()
SECTIONS = {section.get("id"): section for section in ET.fromstring(SOURCE).iter("section")}
LESSONS = ["phone", *sorted(page.stem for page in (ROOT / "docs/lessons").glob("[0-9]_*.md"))]


def text_of(element):
    return " ".join("".join(element.itertext()).split())


def test_there_is_one_for_each_lesson_in_order_and_one_for_the_tasks():
    assert list(SECTIONS) == [*LESSONS, "tasks"]


@pytest.mark.parametrize("lesson", LESSONS)
def test_it_has_the_lessons_title(lesson):
    title = (ROOT / f"docs/lessons/{lesson}.md").read_text().splitlines()[0]
    assert re.sub(r"^# (?:Lesson (\d): )?", lambda match: f"{match[1]}. " if match[1] else "", title) == text_of(
        SECTIONS[lesson].find(".//h1"))


@pytest.mark.parametrize("lesson", LESSONS)
def test_its_commands_are_the_lessons(lesson):
    page = (ROOT / f"docs/lessons/{lesson}.md").read_text()
    commands = [text_of(code) for row in SECTIONS[lesson].findall("table[@class='type']/tr")
                for code in row.findall("td[2]") if len(code) == 1 and not (code.text or "").strip()]
    commands += [text_of(code) for code in SECTIONS[lesson].findall("p[@class='check']/code")]
    assert [command for command in commands if command not in page] == []
    assert commands or lesson == "phone"


def test_the_table_of_scores_has_each_task():
    rows = SECTIONS["tasks"].findall("table[@class='write']/tr/td/code")
    assert sorted(map(text_of, rows)) == sorted(TASKS)


def test_each_has_room_for_a_name_a_goal_and_answers():
    for name, section in SECTIONS.items():
        assert section.find("header/p[@class='name']/b") is not None, name
        assert section.find("p[@class='goal']") is not None, name
        assert section.find(".//hr") is not None, name


def test_it_loads_and_runs_nothing():
    assert not re.search(r"<(script|link|img|iframe|object|embed)|https?:|url\(|@import|\son\w+=", SOURCE)
