"""The pages, followed word for word: every command works, and shows what the page says."""

import pytest
from lesson_pages import boxes
from pupil import ROOT, Offline, Pupil

LESSONS = sorted((ROOT / "docs/lessons").glob("[0-9]*.md"))
WAYS = {  # a new pupil begins with the first lesson, which builds the workspace and opens the terminals
    "lessons 1 to 6": LESSONS[:6],
    "lessons 7 and 8, boards, safety": [LESSONS[0], *LESSONS[6:], ROOT / "docs/boards.md", ROOT / "docs/safety.md"],
}


@pytest.fixture
def pupil(tmp_path):
    pupil = Pupil(tmp_path)
    left = None
    try:
        yield pupil
    finally:
        left = pupil.leave()
    assert not left


@pytest.mark.parametrize("pages", WAYS.values(), ids=WAYS.keys())
def test_pages(pupil, pages):
    offline = []
    for page in pages:
        try:
            pupil.follow(page)
        except Offline as error:
            offline.append(f"{page.name} needs the internet: {error}")
    if offline:
        pytest.skip(f"all else is well, but {offline[0]}")


@pytest.mark.parametrize("text", [
    "Somewhere:\n\n```sh\ntrue\n```\n", "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n",
    "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_that_says_nothing_of_itself_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
