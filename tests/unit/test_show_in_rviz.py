"""RViz with one configuration, for a robot in any namespace; it is restarted when it crashes."""

import runpy

import pytest

from conftest import SIMULATION


@pytest.fixture(scope="module")
def program():
    """The names in show_in_rviz.py."""
    return runpy.run_path(str(SIMULATION / "scripts/show_in_rviz.py"))


@pytest.mark.parametrize("command, code, lines", [
    ("exit 0", 0, 0), ("exit 1", 1, 0), ("kill -TERM $$", -15, 0), ("kill -SEGV $$", -11, 3), ("kill -ABRT $$", -6, 3)])
def test_restarts_when_it_crashes(program, capsys, command, code, lines):
    assert program["run"](["sh", "-c", command]) == code
    assert capsys.readouterr().out == "".join(f"RViz crashed, {tries + 1} of 3 times\n" for tries in range(lines))


def test_frames_of_a_namespace(program):
    config = (SIMULATION / "rviz/simulation.rviz").read_text()
    red = program["add_namespace"](config, "red")
    assert set(red.splitlines()) - set(config.splitlines()) == {
        '      TF Prefix: "red"', "      Target Frame: red/base_footprint"}
