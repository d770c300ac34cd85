"""The bugs that chaos must find can still be planted: what they change is still there, and stays Python."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "chaos"))
from mutants import MUTANTS, PACKAGES, mutate  # noqa: E402


@pytest.mark.parametrize("name", MUTANTS)
def test_a_bug_can_be_planted(name):
    planted = mutate(MUTANTS[name])
    compile(planted, name, "exec")
    assert planted != (PACKAGES / MUTANTS[name].path).read_text()
