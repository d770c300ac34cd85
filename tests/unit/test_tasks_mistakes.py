"""A model solution of each task scores above 95, and typical mistakes get the sentence that they deserve."""

import math

import pytest
from driving_pupil import BEND, arc, follow_for_ever, one_after_the_other, ramp, run, solution, square, straight, turn

from driving_tasks.scoring.score import judge
from driving_tasks.scoring.tasks import TASKS


def result(name, program):
    return judge(TASKS[name], run(program, TASKS[name].load_world()))


@pytest.mark.parametrize("name", TASKS)
def test_a_good_program_scores_above_95(name):
    assert judge(TASKS[name], solution(name)).score > 95


def at_once(speed, seconds):
    def program(robot, start):
        for _ in range(round(seconds / 0.05)):
            yield speed, 0.0
    return program


def cut_corner(robot, start):
    """Drive through the S-bend in a straight line."""
    yield from one_after_the_other(turn(26.57), straight(math.hypot(1, 0.5)), turn(-26.57))(robot, start)


PARK = one_after_the_other(arc(0.5, BEND, stop=False), arc(0.5, -BEND, stop=False))
CCW = (1, 1, 1, 1)
MISTAKES = [
    ("metre", straight(0.95), "stopped 5 cm short of the goal"),
    ("metre", straight(1.12), "stopped 12 cm past the goal"),
    ("metre", straight(-1.0), "stopped 200 cm short of the goal"),
    ("metre", one_after_the_other(straight(1.0), turn(8)), "pointed 8 degrees too far to the left at the end"),
    ("metre", one_after_the_other(straight(1.0), turn(-8)), "pointed 8 degrees too far to the right at the end"),
    ("metre", straight(1.0, speed=0.1), "took 10.2 s; 3.3 s are enough"),
    ("quarter", turn(98), "turned 8 degrees too far at the end"),
    ("quarter", turn(70), "turned 20 degrees too little at the end"),
    ("quarter", turn(-90), "turned to the right, and not to the left"),
    ("quarter", one_after_the_other(straight(0.2), turn(90)), "stopped 20 cm right of the goal"),
    ("square", square(corner_3=98), "turned 8 degrees too far at corner 3"),
    ("square", square(corner_6=82), "turned 8 degrees too little at corner 6"),
    ("square", square(corner=70), "turned 20 degrees too little at corner 1, and 20 degrees on average"),
    ("square", square(side_2=0.9), "drove 10 cm too little on side 2"),
    ("square", square(side=1.06, side_7=1.1), "drove 10 cm too far on side 7, and 6.5 cm on average"),
    ("square", square(corners=CCW), "stopped before corner 5"),
    ("square", square(corners=CCW + CCW), "turned to the left at corner 5, and not to the right"),
    ("square", one_after_the_other(square(), straight(0.5)), "drove on for 50 cm after corner 8"),
    ("circle", arc(0.55, 360), "was 5.1 cm off the line on average, 10 cm to the right at worst"),
    ("circle", arc(0.5, -360), "turned to the right, and not to the left"),
    ("circle", arc(0.5, 180), "turned 180 degrees too little at the end"),
    ("circle", turn(360), "stayed 100 cm away from a part of the line"),
    ("s_bend", cut_corner, "was 4.4 cm off the line on average, 7.2 cm to the left at worst"),
    ("s_bend", arc(0.625, BEND), "stopped 50 cm short of the goal and 25 cm right of it"),
    ("smooth", at_once(0.3, 3.333), "sped up at 1.3 m/s^2, and 0.3 are allowed"),
    ("smooth", ramp(1.0, 0.45), "braked at 0.54 m/s^2, and 0.3 are allowed"),
    ("smooth", ramp(1.0, 0.05), "took 7.9 s; 4.3 s are enough"),
    ("park", one_after_the_other(PARK, at_once(0.3, 2.0), straight(-0.065)), "touched a wall"),
    ("park", one_after_the_other(PARK, straight(0.2)), "stopped 10 cm short of the goal"),
    ("follow", straight(1.9566), "stopped 46 cm past the goal and 80 cm right of it"),
    ("camera", straight(1.36, speed=0.2), "stopped 80 cm right of the goal"),
    ("follow", follow_for_ever, "was still driving 10 cm past the goal"),
    ("camera", follow_for_ever, "was still driving 10 cm past the goal"),
    ("roam", turn(3600), "was in 0 squares of the floor, and 30 are wanted"),
    ("roam", arc(0.1, 3600), "was in 1 square of the floor, and 30 are wanted"),
    ("roam", arc(0.2, 1800), "was in 6 squares of the floor, and 30 are wanted"),
    ("roam", at_once(0.3, 20), "was in 4 squares of the floor, and 30 are wanted"),
    ("roam", one_after_the_other(*[straight(0.5), straight(-0.5)] * 9),
     "was in 2 squares of the floor, and 30 are wanted"),
]


@pytest.mark.parametrize("name", TASKS)
def test_each_task_has_typical_mistakes(name):
    assert name in [row[0] for row in MISTAKES], f"write into MISTAKES of tests/unit/test_tasks_mistakes.py: {name!r}"


@pytest.mark.parametrize("name, program, sentence", MISTAKES, ids=[f"{row[0]}: {row[2]}" for row in MISTAKES])
def test_the_largest_loss_of_a_typical_mistake(name, program, sentence):
    assert result(name, program).largest_loss == sentence


def test_a_circle_is_too_little_for_lesson_12():
    needed = pytest.importorskip("jetbot_lessons.package_files").NEEDED["roam"]
    assert 20 < result("roam", arc(0.225, 3000)).score < needed
