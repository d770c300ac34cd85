"""The lessons, followed word for word: every command works, and shows what the page says."""

import pytest
from lesson_pages import boxes
from pupil import ROOT, Offline, Pupil

PAGES = {int(page.name[0]): page for page in sorted((ROOT / "docs/lessons").glob("[0-9]*.md"))}
BEFORE = {8: (1, 7)}  # which lessons one builds on; the others on the first alone


@pytest.fixture(scope="module")
def pupils(tmp_path_factory):
    """The pupil who follows the lessons: one for all, since a new one must build a workspace first."""
    pupils = []
    yield pupils
    for pupil in pupils:
        assert not pupil.leave()


@pytest.fixture
def pupil(pupils, tmp_path_factory):
    """A pupil with whom nothing has gone wrong yet."""
    if not pupils or pupils[-1].lost:
        pupils.append(Pupil(tmp_path_factory.mktemp("home")))
    return pupils[-1]


@pytest.mark.parametrize("number", PAGES)
def test_lesson(pupil, number):
    for page in (PAGES[before] for before in (*BEFORE.get(number, (1,)), number)):
        if page not in pupil.followed:
            try:
                pupil.follow(page)
            except Offline as error:
                pytest.skip(f"{page.name} needs the internet: {error}")


@pytest.mark.parametrize("text", [
    "Somewhere:\n\n```sh\ntrue\n```\n", "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n",
    "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_that_says_nothing_of_itself_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
