"""The pages, followed word for word: every command works, and shows what the page says."""

import pytest
from lesson_pages import boxes
from pupil import ROOT, Offline, Pupil

LESSONS = sorted((ROOT / "docs/lessons").glob("[0-9]*.md"))
PAGES = {page.stem: page for page in [*LESSONS, ROOT / "docs/boards.md", ROOT / "docs/safety.md"]}
BEFORE = {"8_your_launch_file": "7_your_package"}  # the page that one builds on, after the first


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


@pytest.mark.parametrize("name", PAGES)
def test_page(pupil, name):
    before = [LESSONS[0], *([PAGES[BEFORE[name]]] if name in BEFORE else [])]
    try:
        for page in [*before, PAGES[name]]:
            if page not in pupil.followed:
                pupil.follow(page)
    except Offline as error:
        pytest.skip(f"{name} needs the internet: {error}")


@pytest.mark.parametrize("text", [
    "Somewhere:\n\n```sh\ntrue\n```\n", "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n",
    "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_that_says_nothing_of_itself_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
