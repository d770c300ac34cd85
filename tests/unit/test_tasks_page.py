"""docs/tasks.md has the tasks, the numbers and the arithmetic of the code."""

import math
import re
from functools import partial

import pytest

from conftest import ROOT
from driving_tasks.scoring import measures, penalties, score
from driving_tasks.scoring.recorder import STILL, STILL_DEGREES, STOP_TIME, TWITCH, Drive, Sample
from driving_tasks.scoring.score import rate
from driving_tasks.scoring.tasks import ACCELERATION, TASKS
from jetbot.kinematics import FULL_SPEED, WHEEL_SEPARATION, Pose

PAGE = (ROOT / "docs/tasks.md").read_text()
TEXT = " ".join(PAGE.split())
ROWS = {row[0].strip("`"): row[1:] for row in (
    [cell.strip() for cell in line.strip("|").split("|")] for line in PAGE.splitlines() if line.startswith("|"))}


def name_of(function):
    return (function.func if isinstance(function, partial) else function).__name__


@pytest.mark.parametrize("name", TASKS)
def test_the_table_of_tasks(name):
    task = TASKS[name]
    assert ROWS[name] == [task.instruction, f"{task.ideal_seconds:.2f} s", ", ".join(map(name_of, task.measures)),
                          ", ".join(map(name_of, task.penalties))]


def test_each_task_measure_and_penalty_is_in_a_table():
    assert [name for name in ROWS if len(ROWS[name]) == 4 and ROWS[name][1].endswith(" s")] == list(TASKS)
    used = {name_of(each) for task in TASKS.values() for each in (*task.measures, *task.penalties)}
    assert used <= set(ROWS)


def test_the_example():
    path = (Sample(0.0, Pose(), 0.0), Sample(4.0, Pose(0.97), 0.0))
    result = rate(TASKS["metre"], Drive(path, 4.0, Pose()))
    assert f"= {result.score:.1f}\n" in PAGE
    error, time = result.losses
    assert f'"{error.sentence} ({error.points:.1f} points)", and the time would cost {time.points:.1f}' in TEXT
    assert f"exp(-3 / 10)               = {100 * math.exp(-0.3):.2f}\n" in PAGE
    assert f"3.33 / 4             = {0.8 + 0.2 * TASKS['metre'].ideal_seconds / 4:.3f}\n" in PAGE


def test_the_arcs():
    for name in ("s_bend", "park"):
        arc = TASKS[name].steps[0]
        assert re.search(rf"{arc.degrees:.2f} degrees and {arc.radius:g} m", TEXT)


def test_the_robot():
    turn = math.degrees(2 * FULL_SPEED / WHEEL_SEPARATION)
    assert f"drive {FULL_SPEED} m/s at full power, and are {WHEEL_SEPARATION} m apart" in TEXT
    assert f"z * {turn:.0f} degrees per second" in TEXT and f"radius x / z * {WHEEL_SEPARATION / 2:.5f} m" in TEXT


def test_the_numbers_of_the_score():
    assert f"exp(-error / {score.TOLERANCE:g}) * ({1 - score.TIME_SHARE:g} + {score.TIME_SHARE:g} * min(" in PAGE
    assert f"5 degrees leave {100 * math.exp(-5 / score.TOLERANCE):.1f} points" in TEXT
    assert f"left its start by {1000 * STILL:g} mm or {STILL_DEGREES} degrees" in TEXT
    assert f"stopped for {STOP_TIME:g} s" in TEXT
    assert f"less than {100 * TWITCH * STILL:g} cm and {TWITCH * STILL_DEGREES:g} deg" in TEXT
    assert ROWS["contacts"][0].startswith(f"{penalties.CONTACT:g} for each time")
    assert f"after {100 * penalties.SEPARATED:g} cm of distance" in ROWS["contacts"][0]
    assert ROWS["acceleration"][0].startswith(
        f"{penalties.EXCESS:g} for each 100 % above {ACCELERATION} m/s^2, {penalties.MAX_EXCESS:g} at most; "
        f"means over {penalties.WINDOW} s count, and up to {100 * (penalties.ALLOWANCE - 1):.0f} % ")
    assert {name_of(measures.end), name_of(measures.line)} < set(ROWS)
