"""The score against closed forms, and what it does not depend on."""

import math
import time

import pytest
from driving_pupil import follow_for_ever, run, solution, straight

from driving_tasks.scoring.course import Arc, Straight, Turn, advance
from driving_tasks.scoring.measures import corners
from driving_tasks.scoring.recorder import Drive, NoDrive, Sample
from driving_tasks.scoring.score import judge, rate
from driving_tasks.scoring.tasks import TASKS
from jetbot.kinematics import Pose, from_frame


@pytest.mark.parametrize("name, seconds, goal", [
    ("metre", 1 / 0.3, (1, 0, 0)), ("quarter", 1.0, (0, 0, math.pi / 2)), ("square", 8 / 0.3 + 8, (0, 0, 0)),
    ("circle", math.pi / 0.3, (0, 0, math.tau)), ("s_bend", 2 * 0.625 * 0.9272952 / 0.3, (1, 0.5, 0)),
    ("smooth", 1 / 0.3 + 1, (1, 0, 0)), ("park", (2 * 0.5 * 0.9272952 + 0.3) / 0.3, (1.1, 0.4, 0)),
    ("follow", (0.7 + 0.4 * math.pi) / 0.2, (1.5, 0.8, 0))])
def test_the_ideal_drive(name, seconds, goal):
    assert TASKS[name].ideal_seconds == pytest.approx(seconds, abs=1e-6)
    assert TASKS[name].course.goal == pytest.approx(goal, abs=1e-12)


def driven(steps, seconds, acceleration=math.inf):
    """Return a drive of exactly these steps in so many seconds, which speeds up to 0.3 m/s, or brakes from there."""
    poses = [Pose()]
    for step in steps:
        count = math.ceil(200 * (abs(step.length) or math.radians(abs(step.degrees))))
        poses += [advance(poses[-1], step, number / count) for number in range(1, count + 1)]
    times = [seconds * number / (len(poses) - 1) for number in range(len(poses))]
    speeds = [max(0.0, min(0.3, acceleration * time + (0.3 if acceleration < 0 else 0.0))) for time in times]
    return Drive(tuple(map(Sample, times, poses, speeds)), seconds, Pose())


LEFT, RIGHT, AROUND = Turn(90), Turn(-90), Turn(180)
METRE, PARK, FOLLOW = TASKS["metre"].steps, TASKS["park"].steps, TASKS["follow"].steps
TOUCH, LEAVE = Straight(0.065), Straight(-0.065)  # the wall ahead of the goal of PARK


@pytest.mark.parametrize("name, drive, score", [  # by docs/tasks.md, and by hand
    ("metre", driven(METRE, 3.33), 100),
    ("metre", driven([Straight(0.97)], 3.33), 74.08),                     # 3 cm
    ("metre", driven([Straight(1.03)], 3.33), 74.08),
    ("metre", driven([*METRE, Turn(-8)], 3.33), 44.93),                   # 8 degrees
    ("metre", driven([Straight(0.95), Turn(3)], 3.33), 60.65),            # the larger: 5 cm
    ("metre", driven(METRE, 6.667), 90),                                  # twice the time
    ("metre", driven(METRE, 13.333), 85),
    ("metre", driven(METRE, 1.0), 100),
    ("metre", driven([Straight(0.97)], 4.0), 71.61),                      # 74.08 * 0.967
    ("quarter", driven([Turn(95)], 1.0), 60.65),
    ("quarter", driven([RIGHT], 1.0), 0),
    ("square", driven([Straight(0.95), LEFT] * 4 + [Straight(0.95), RIGHT] * 4, 30), 60.65),
    ("square", driven([Straight(1.0), Turn(95)] * 4 + [Straight(1.0), Turn(-95)] * 4, 30), 60.65),
    ("square", driven([Straight(0.95), Turn(95)] * 4 + [Straight(0.95), Turn(-95)] * 4, 30), 36.79),
    ("square", driven([Straight(1.0), Turn(98)] + [Straight(1.0), LEFT] * 3 + [Straight(1.0), RIGHT] * 4, 30), 90.48),
    ("square", driven([Straight(1.0), LEFT] * 4, 30), 0.01),              # 50 cm and 45 degrees
    ("circle", driven([Arc(0.55, 360)], 10), 60.05),                      # 5.1 cm beside the line
    ("circle", driven([Arc(0.5, -360)], 10), 0),
    ("circle", driven([Turn(360)], 10), 0.17),                            # 63.7 cm from the line
    ("s_bend", driven([Arc(0.625, 53.13), Arc(0.625, -53.13)], 3.8), 100),
    ("follow", driven([*FOLLOW[:3], Straight(0.25)], 9), 60.19),          # 5 cm, and 15 cm / 197 points
    ("camera", driven([*FOLLOW, Straight(0.05), Straight(-0.05)], 9), 98.8),  # 25 cm / 206
    ("smooth", driven(METRE, 4.33, 0.3), 100),
    ("smooth", driven(METRE, 4.33, 0.325), 100),                          # 8 % too much
    ("smooth", driven(METRE, 4.33, 0.45), 90),                            # 50 %
    ("smooth", driven(METRE, 4.33, -0.6), 80),                            # 100 %
    ("smooth", driven(METRE, 4.33, 3.0), 60),                             # 400 %
    ("park", driven(PARK, 4), 100),
    ("park", driven([*PARK, TOUCH, LEAVE], 4), 80),
    ("park", driven([*PARK, TOUCH, Straight(-0.008), Straight(0.008), LEAVE], 4), 80),  # still the same contact
    ("park", driven([*PARK, TOUCH, Straight(-0.015), Straight(0.015), LEAVE], 4), 60),  # another one
    ("park", driven([*PARK, *[TOUCH, LEAVE] * 6], 4), 0),
    ("roam", driven([Straight(0.75), AROUND, Straight(1.5)], 60), 20),    # 6 of 30 squares
    ("roam", driven([Straight(0.5), Straight(0.5), Straight(-0.5), AROUND, Straight(1.25)], 60), 3.33),  # 7; a contact
    ("roam", driven([Straight(1.0), Straight(-1.0)], 60), 0),             # 4 squares, less than a contact costs
])
def test_the_score_of_a_drive(name, drive, score):
    assert rate(TASKS[name], drive).score == pytest.approx(score, abs=0.06)


@pytest.mark.parametrize("name", TASKS)
def test_the_score_does_not_depend_on_the_rate_of_the_samples(name):
    samples = solution(name)
    fewer = [samples[round(number * 100 / 30)] for number in range(len(samples) * 30 // 100)]
    assert judge(TASKS[name], fewer).score == pytest.approx(judge(TASKS[name], samples).score, abs=0.3)


@pytest.mark.parametrize("name", TASKS)
def test_the_score_does_not_depend_on_where_the_robot_starts(name):
    start = Pose(12.3, -45.6, 2.9)
    samples = solution(name)
    moved = [Sample(stamp + 1.6e9, Pose(*from_frame(start, pose[:2]), math.remainder(pose.yaw + start.yaw, math.tau)),
                    *velocity) for stamp, pose, *velocity in samples]
    result = judge(TASKS[name], moved)
    assert result.score == pytest.approx(judge(TASKS[name], samples).score, abs=1e-4)
    assert result.drive.frame == pytest.approx(start)


@pytest.mark.parametrize("name", [name for name in TASKS if TASKS[name].steps])
def test_the_ideal_drive_leaves_100_points(name):
    task = TASKS[name]
    assert rate(task, driven(task.steps, task.ideal_seconds, 0.3)).score == pytest.approx(100, abs=0.1)


@pytest.mark.parametrize("name", ["metre", "square", "smooth"])
def test_the_score_is_the_same_float_with_samples_before_and_after_and_each_time(name):
    task, samples = TASKS[name], solution(name)
    before = [samples[0]._replace(time=samples[0].time - number / 50) for number in range(500, 0, -1)]
    after = [samples[-1]._replace(time=samples[-1].time + number / 50) for number in range(1, 500)]
    again = [sample._replace(time=samples[-1].time + 20 + sample.time) for sample in samples]
    scores = {judge(task, each).score for each in [
        samples, samples, before + samples, samples + after, before + samples + after + again]}
    assert len(scores) == 1


def test_rounded_corners_are_corners():
    rounded = [step for side in (1, -1) for _ in range(4) for step in (Straight(0.8), Arc(0.1, side * 90))]
    errors = [error.size for error in corners(TASKS["square"].course, driven(rounded, 30))]
    assert errors == pytest.approx([0.0] * 8, abs=0.2)


def test_a_robot_that_creeps_has_not_stopped():
    metre = [sample for sample in run(straight(1.0)) if sample.pose.x < 0.95]
    end = metre[-1].time
    creeping = [Sample(end + number / 50, Pose(0.95 + 0.0008 * number / 50), 0.0008) for number in range(500)]
    assert judge(TASKS["metre"], metre + creeping).drive.end.x == pytest.approx(0.958, abs=0.001)


def test_a_robot_that_is_put_back_starts_again():
    half, whole = run(straight(0.5)), run(straight(1.0))
    later = [sample._replace(time=sample.time + 10) for sample in whole]
    assert judge(TASKS["metre"], half[:100] + later).score == pytest.approx(judge(TASKS["metre"], whole).score)


def test_a_twitch_is_no_drive():
    twitch, whole = run(straight(0.009)), run(straight(1.0))
    start = twitch[-1]
    later = [Sample(start.time + 0.01 + sample.time, sample.pose._replace(x=sample.pose.x + start.pose.x), sample.speed)
             for sample in whole]
    assert judge(TASKS["metre"], twitch + later).score == pytest.approx(judge(TASKS["metre"], whole).score, abs=0.01)
    with pytest.raises(NoDrive):
        judge(TASKS["metre"], twitch)


def test_a_robot_that_never_stops_is_judged_after_the_time_limit():
    samples = [Sample(number / 50, Pose(0.01 * number / 50), 0.01) for number in range(10000)]
    assert judge(TASKS["metre"], samples).drive.seconds == pytest.approx(60, abs=0.2)


def test_a_robot_that_drives_on_past_the_tape_is_judged_there_at_once_and_gets_points():
    samples = run(follow_for_ever, TASKS["follow"].load_world())
    result = judge(TASKS["follow"], samples)
    assert result.drive.end.x == pytest.approx(1.6, abs=0.01) and result.drive.seconds < 20
    assert 25 < result.score < 40
    assert judge(TASKS["metre"], run(straight(1.5))).drive.end.x == pytest.approx(1.5, abs=0.01)


def test_a_drive_ends_where_the_samples_stop_for_3_s():
    samples = run(straight(1.0))
    half = [sample for sample in samples if sample.time < 1.5]
    result = judge(TASKS["metre"], half + [sample._replace(time=sample.time + 1e7) for sample in samples[len(half):]])
    assert result == judge(TASKS["metre"], half) and result.drive.seconds < 1.5


NAN, INF = math.nan, math.inf
HOSTILE = {
    "nothing": lambda number: None,
    "not a number": lambda number: Sample(NAN, Pose(NAN, INF, -INF), NAN),
    "backward in time": lambda number: Sample(-0.02 * number, Pose(0.001 * number), 0.1),
    "jumps": lambda number: Sample(0.02 * number, Pose(number % 2 * 100.0), 0.0),
    "huge": lambda number: Sample(1e300 * number, Pose(1e300, -1e300, 1e300), 1e300),
    "is still": lambda number: Sample(0.02 * number, Pose(3.0, 4.0, 5.0), 0.0),
    "twitches": lambda number: Sample(0.02 * number, Pose(0.005 * (number // 200 % 2)), 0.0),
    "drives back and forth": lambda number: Sample(0.00501 * number, Pose(0.009 * (number % 2)), 1.9),
}


@pytest.mark.parametrize("kind", HOSTILE)
def test_a_long_hostile_drive_ends_soon_with_a_sentence(kind):
    samples = [sample for sample in map(HOSTILE[kind], range(10_000)) if sample]
    began = time.monotonic()
    with pytest.raises(NoDrive, match=r"^[A-Z].*\.$"):
        judge(TASKS["square"], samples)
    assert time.monotonic() - began < 5


def test_a_wild_drive_is_judged_soon():
    samples = [Sample(0.00501 * number, Pose(0.009 * (number % 7), 0.009 * (number % 5), number % 4 * 0.05), 1.9)
               for number in range(10_000)]
    began = time.monotonic()
    assert judge(TASKS["circle"], samples).score < 1e-6
    assert time.monotonic() - began < 5
