"""The page's Python prints and fails as Python does: see text_differential.py. Its texts drive as blocks do."""

from differential import difference as difference_of_drives
from javascript import needs_node
from program_node import Run, translate
from text_differential import difference, random_differences, run_here, run_in_page, run_texts

from conftest import ROOT

pytestmark = needs_node
FILES = sorted((ROOT / "tests/programs/language").glob("*.py"))


def test_what_pupils_use_of_the_language_does_the_same_in_the_page():
    done = run_in_page({file.name: file.read_text() for file in FILES})
    for file in FILES:
        here = run_here(file.read_text())
        assert here.error and len(here.prints) > 9, "it fails in its last line"
        assert difference(done[file.name], here) == "", file.name


def test_20_random_texts_do_the_same_in_the_page():
    for seed, text, found in random_differences(seed=1, count=20):
        raise AssertionError(f"program {seed}: {found}\n{text}")


def test_each_example_of_blocks_drives_the_same_as_a_text():
    examples = translate("examples")
    done = run_texts({name: page["python"] for name, page in examples.items()})
    assert len(done) > 5
    for name, page in examples.items():
        assert difference_of_drives(page, driven(done[name])) == "", name


def driven(done):
    """Return what a text has printed and commanded; its clock begins at its first command."""
    rows = [row if isinstance(row, str) else list(map(float, row)) for row in done["trace"]]
    begin = next(row[0] for row in rows if not isinstance(row, str))
    return Run([row if isinstance(row, str) else [row[0] - begin, *row[1:]] for row in rows], None, [], done["cut"])
