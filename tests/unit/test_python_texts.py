"""The page's Python prints and fails as Python does: see differential.py. Its texts drive as blocks do."""

from differential import check, difference, differences, report, run_texts
from javascript import needs_node
from program_node import Run, translate

from conftest import ROOT

pytestmark = needs_node
FILES = sorted((ROOT / "tests/programs/language").glob("*.py"))


def test_20_random_texts_in_any_style_do_the_same_in_the_page():
    check("texts", seed=1, count=20)


def test_what_pupils_use_of_the_language_does_the_same_in_the_page():
    pages = run_texts({file.name: file.read_text() for file in FILES})
    assert all(page["problem"] and len(page["prints"]) > 9 for page in pages.values()), "each fails in its last line"
    for differs in differences("texts", pages):
        raise AssertionError(report(differs))


def test_each_example_of_blocks_drives_the_same_as_a_text():
    examples = translate("examples")
    done = run_texts({name: page["python"] for name, page in examples.items()})
    assert len(done) > 5
    for name, page in examples.items():
        assert difference(page, driven(done[name])) == "", name


def driven(done):
    """Return what a text has printed and commanded; its clock begins at its first command."""
    begin = next(row[0] for row in done["trace"] if not isinstance(row, str))
    return Run([row if isinstance(row, str) else [row[0] - begin, *row[1:]] for row in done["trace"]], None, [],
               done["cut"])
