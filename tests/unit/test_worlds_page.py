"""docs/worlds.md: its example is a world, its lists are complete, and its sentences are the simulator's."""

import re

import pytest
from test_docs import numbers, rows, section

from conftest import ROOT
from jetbot import InvalidValue
from jetbot.kinematics import Pose
from simulation.world import FOOTPRINT, LINE_WIDTH
from simulation.world_files import KEYS, MAX_POINTS, load, names, parse

PAGE = (ROOT / "docs/worlds.md").read_text()
(EXAMPLE,) = re.findall(r"^```yaml\n(.*?)^```", PAGE, re.M | re.S)


def test_the_example_is_a_world_with_a_wall_ahead_and_a_line_below_the_robot():
    world = parse(EXAMPLE)
    assert (len(world.walls), len(world.lines)) == (2, 1)
    assert world.clearance(Pose()) == pytest.approx(0.3 - FOOTPRINT.top)
    assert world.clearance(Pose(0.5, 0.0, 0.0)) == pytest.approx(0.1 - FOOTPRINT.right)
    assert world.line_sensor(Pose())[1] == 0


def test_each_shipped_world_and_each_key_is_listed():
    assert re.findall(r"^\| `(\w+\.yaml)` \|", PAGE, re.M) == names()
    assert re.findall(r"^\| `(\w+)` \|", PAGE, re.M) == list(KEYS)
    reference = (ROOT / "docs/reference.md").read_text()
    assert f"or {', '.join(f'`{name}`' for name in names())} |" in reference


def test_the_numbers_are_those_of_the_code():
    assert {-FOOTPRINT.left, FOOTPRINT.right, FOOTPRINT.top} <= numbers(section(PAGE, "Walls"))
    assert numbers(next(row[1] for row in rows(PAGE) if row[0] == "`line_width`")) == {LINE_WIDTH}
    assert MAX_POINTS in numbers(section(PAGE, "Write a world"))


def test_what_it_says_of_a_mistake_is_what_the_simulator_says():
    with pytest.raises(InvalidValue) as error:
        parse(EXAMPLE.replace("[0.6, 0.5]", "[0.6]"), "the world /home/me/room.yaml")
    assert f"\n{error.value}\n" in PAGE


@pytest.mark.parametrize("y", [0.0, -0.015])
def test_the_eyes_see_what_the_page_says(y):
    seen = [round(eye, 4) for eye in load("line.yaml").line_sensor(Pose(0.1, y, 0.0))]
    assert f"{seen}`" in PAGE
