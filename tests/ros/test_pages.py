"""The pages, followed word for word: every command works, and shows what the page shows."""

import pytest
from lesson_pages import boxes
from pupil import LESSONS, ROOT, follow

DOCS = ROOT / "docs"


@pytest.mark.parametrize("pages, package", [
    ([*LESSONS[:6], DOCS / "boards.md", DOCS / "safety.md"], ""),
    ([LESSONS[0], *LESSONS[6:9]], ""),  # lesson 1 opens terminals
    ([LESSONS[0], *LESSONS[9:11]], "my_scenario"),
    ([LESSONS[0], *LESSONS[11:]], "my_scenario sensor_msgs std_msgs")],
    ids=["first lessons", "own package", "camera", "free or blocked"])
def test_pages(tmp_path, pages, package):
    follow(pages, tmp_path, package)


@pytest.mark.parametrize("text", [
    "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n", "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_of_no_known_kind_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
