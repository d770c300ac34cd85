"""The pages, followed word for word: every command works, and shows what the page shows."""

import ast
import xml.etree.ElementTree as ET

import pytest
from lesson_pages import FILE, boxes
from pupil import LESSONS, ROOT, Offline, Pupil

GROUPS = {  # pages that one pupil follows, one after the other; the longest group decides how long all tests take
    "first": [*LESSONS[:3], ROOT / "docs/boards.md"],
    "next": [*LESSONS[3:6], ROOT / "docs/safety.md"],
    "own": LESSONS[6:9],
    "camera": LESSONS[9:11],
    "sight": LESSONS[11:]}
PAGES = [page for pages in GROUPS.values() for page in pages]
READERS = {".py": ast.parse, ".xml": ET.fromstring, ".launch": ET.fromstring}  # raise SyntaxError


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.stem)
def test_the_form_of_a_page(page):
    files = [box for box in boxes(page) if box.how == FILE]
    for box in files:
        READERS.get(box.file[box.file.rfind("."):], str)(box.text)


@pytest.fixture(scope="module")
def pupil(request, tmp_path_factory):
    """A pupil of one group."""
    pupil = Pupil(tmp_path_factory.mktemp("home"))
    yield pupil
    assert not pupil.leave()


@pytest.mark.parametrize("pupil, page", [
    pytest.param(group, page, id=f"{group}-{page.stem}") for group, pages in GROUPS.items() for page in pages],
    indirect=["pupil"])
def test_pages(pupil, page):
    try:
        pupil.prepare(page)
        pupil.follow(page)
    except Offline as error:
        pytest.skip(f"{page.name} needs the internet, and all before that works: {error}")
    except AssertionError:
        pupil.leave()  # what still runs would disturb the next page
        raise


@pytest.mark.parametrize("text", [
    "```sh\ntrue\n```\n", "Terminal 1:\n```sh\ntrue\n```\n", "Terminal 1, leave it:\n\n```sh\ntrue\n```\n"])
def test_a_box_of_no_known_kind_is_refused(tmp_path, text):
    page = tmp_path / "page.md"
    page.write_text(text)
    with pytest.raises(ValueError, match=r"page\.md"):
        list(boxes(page))
