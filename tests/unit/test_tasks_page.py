"""docs/tasks.md has the tasks, the numbers and the arithmetic of the code."""

import math
from functools import partial

import pytest
from recipes import require_lines, require_rows
from test_docs import numbers, rows, section

from conftest import ROOT
from driving_tasks.scoring import measures, penalties, score
from driving_tasks.scoring.recorder import STILL, STILL_DEGREES, STOP_TIME, TWITCH, Drive, Sample
from driving_tasks.scoring.score import rate
from driving_tasks.scoring.tasks import ACCELERATION, TASKS
from jetbot.kinematics import FULL_SPEED, WHEEL_SEPARATION, Pose

FILE = ROOT / "docs/tasks.md"
PAGE = FILE.read_text()
TEXT = " ".join(PAGE.split())
ROWS = {row[0].strip("`"): row[1:] for row in rows(PAGE)}


def name_of(function):
    return (function.func if isinstance(function, partial) else function).__name__


@pytest.mark.parametrize("name", TASKS)
def test_the_table_of_tasks(name):
    task = TASKS[name]
    cells = [f"`{name}`", task.instruction, f"{task.ideal_seconds:.2f} s", ", ".join(map(name_of, task.measures)),
             ", ".join(map(name_of, task.penalties))]
    require_lines(FILE, ["".join(f"| {cell} " if cell else "| " for cell in cells) + "|"])


def test_each_task_measure_and_penalty_is_in_a_table():
    require_rows(FILE, [name for name in ROWS if len(ROWS[name]) == 4 and ROWS[name][1].endswith(" s")], TASKS)
    used = {name_of(each) for task in TASKS.values() for each in (*task.measures, *task.penalties)}
    assert used <= set(ROWS), f"write into the tables of docs/tasks.md: {used - set(ROWS)}"


def test_the_example():
    path = (Sample(0.0, Pose(), 0.0), Sample(4.0, Pose(0.97), 0.0))
    result = rate(TASKS["metre"], Drive(path, 4.0, Pose()))
    assert f"= {result.score:.1f}\n" in PAGE
    error, time = result.losses
    assert f'"{error.sentence} ({error.points:.1f} points)"' in TEXT
    assert {round(time.points, 1), round(error.points, 1)} <= numbers(section(PAGE, "The score"))
    assert f"exp(-3 / 10)               = {100 * math.exp(-0.3):.2f}\n" in PAGE
    assert f"3.33 / 4             = {0.8 + 0.2 * TASKS['metre'].ideal_seconds / 4:.3f}\n" in PAGE


def test_the_arcs():
    for arc in (TASKS[name].steps[0] for name in ("s_bend", "park")):
        assert {round(arc.degrees, 2), round(arc.radius, 3)} <= numbers(section(PAGE, "The course"))


def test_the_robot():
    turn = round(math.degrees(2 * FULL_SPEED / WHEEL_SEPARATION))
    assert {FULL_SPEED, WHEEL_SEPARATION, WHEEL_SEPARATION / 2, turn} <= numbers(section(PAGE, "The robot"))


def test_the_numbers_of_the_score():
    assert f"exp(-error / {score.TOLERANCE:g}) * ({1 - score.TIME_SHARE:g} + {score.TIME_SHARE:g} * min(" in PAGE
    five_off = round(100 * math.exp(-5 / score.TOLERANCE), 1)
    assert {five_off, 100 * TWITCH * STILL, TWITCH * STILL_DEGREES, STOP_TIME} <= numbers(section(PAGE, "The score"))
    assert f"{1000 * STILL:g} mm or {STILL_DEGREES} degrees" in TEXT
    assert numbers(ROWS["contacts"][0]) == {penalties.CONTACT, 100 * penalties.SEPARATED}
    assert numbers(ROWS["acceleration"][0].replace("m/s^2", "")) == {
        penalties.EXCESS, 100, ACCELERATION, penalties.MAX_EXCESS, penalties.WINDOW,
        round(100 * (penalties.ALLOWANCE - 1))}
    assert {name_of(measures.end), name_of(measures.line)} < set(ROWS)
