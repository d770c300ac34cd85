"""The lessons, followed word for word: every command works, and shows what the page says."""

import pytest
from lesson_pages import boxes
from pupil import ROOT, Offline, Pupil

PAGES = {int(page.name[0]): page for page in (ROOT / "docs/lessons").glob("[0-9]*.md")}
KEYBOARD = 4  # needs the internet; the other lessons do not need it


@pytest.fixture
def pupil(tmp_path):
    pupil = Pupil(tmp_path)
    left = None
    try:
        yield pupil
    finally:
        left = pupil.leave()
    assert not left


def test_lessons(pupil):
    for number in sorted(set(PAGES) - {KEYBOARD}):
        pupil.follow(PAGES[number])


def test_keyboard_lesson(pupil):
    pupil.follow(PAGES[1])
    try:
        pupil.follow(PAGES[KEYBOARD])
    except Offline as error:
        pytest.skip(f"lesson {KEYBOARD} needs the internet: {error}")


@pytest.mark.parametrize("text", [
    "Somewhere:\n\n```sh\ntrue\n```\n", "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n",
    "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_that_says_nothing_of_itself_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
