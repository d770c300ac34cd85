"""The pages, followed word for word: every command works, and shows what the page shows."""

import pytest
from lesson_pages import boxes
from pupil import LESSONS, ROOT, follow


def test_your_own_package_and_the_other_pages(tmp_path):
    docs = ROOT / "docs"
    follow([LESSONS[0], *LESSONS[6:], docs / "boards.md", docs / "safety.md"], tmp_path)  # the first opens terminals


@pytest.mark.parametrize("text", [
    "Somewhere:\n\n```sh\ntrue\n```\n", "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n",
    "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_of_no_known_kind_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
