"""What the pages weigh on the wire, and that browsers keep their files for as long as these are the same."""

import re
import shutil

import pytest

from jetbot_cockpit.web.page_files import CHECKED, COMMENT, FOREVER, NEVER, WWW, read_files

HEADERS = 240  # bytes of an answer
VERSIONED = re.compile(r"[0-9a-f]{16}/(.+)")


@pytest.fixture(scope="module")
def served():
    return read_files()


def loaded(served, page):
    """Return the names of the files that a page loads."""
    return set(re.findall(r'(?:src|href)="([^"]+\.\w+)"', served[page].plain.decode()))


def test_the_page_for_programs_is_first_loaded_with_less_than_250_kb(served):
    files = [served["program.html"], *map(served.__getitem__, loaded(served, "program.html"))]
    assert len(files) > 50
    assert sum(len(file.brotli or file.gzip) + HEADERS for file in files) < 250_000


@pytest.mark.parametrize("page", ["program.html", "index.html"])
def test_a_page_is_loaded_again_with_less_than_20_kb_since_the_browser_keeps_all_else(served, page):
    assert {served[name].cache for name in loaded(served, page)} == {FOREVER}
    assert served[page].cache == NEVER and len(served[page].gzip) + HEADERS < 20_000


@pytest.mark.parametrize("page", ["program.html", "index.html"])
def test_a_page_names_all_its_modules_so_that_they_come_at_once(served, page):
    names = {VERSIONED.fullmatch(name)[1] for name in loaded(served, page)}
    for name in [name for name in names if name.endswith(".js") and "vendor" not in name]:
        for path in re.findall(r'^(?!.*@import).*(?:from|import) "(\.[^"]+)"', (WWW / name).read_text(), re.M):
            assert ((WWW / name).parent / path).resolve().relative_to(WWW.resolve()).as_posix() in names


def test_all_addresses_change_with_any_file_and_a_file_alone_is_checked(served, tmp_path):
    folder = tmp_path / "www"
    shutil.copytree(WWW, folder)
    assert read_files(folder).keys() == served.keys() and served["dom.js"].cache == CHECKED
    (folder / "dom.js").write_text("export const changed = 1;\n")
    assert not loaded(read_files(folder), "program.html") & loaded(served, "program.html")


def test_scripts_lose_only_comments_and_their_lines_keep_their_numbers(served):
    for name in [name for name in served if name.endswith(".js") and "vendor" not in name and (WWW / name).exists()]:
        text = (WWW / name).read_bytes()
        assert served[name].plain.count(b"\n") == text.count(b"\n")
        for comment in COMMENT.finditer(text):
            assert text[:comment.start()].count(b"`") % 2 == 0, f"{name}: a part of a text looks like a comment"
        assert not COMMENT.search(served[name].plain)
    assert b"perhaps in the middle" not in served["program/ask.js"].plain, "at the end of a line"


def test_styles_lose_their_comments_alone(served):
    for name in [name for name in served if name.endswith(".css") and "vendor" not in name and (WWW / name).exists()]:
        text = (WWW / name).read_text()
        assert "/*" not in served[name].plain.decode(), name
        assert re.sub(r"\s|/\*.*?\*/", "", text) == re.sub(r"\s", "", served[name].plain.decode()), name
