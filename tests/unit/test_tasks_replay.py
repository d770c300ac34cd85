"""A drive from its commands alone: the simulated robot, at a fixed step, with the controller's units and timeout."""

import math

import pytest

from driving_tasks.scoring.recorder import NoDrive
from driving_tasks.scoring.score import judge
from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.replay import replay
from simulation.world import FOOTPRINT

METRE = TASKS["metre"]
SI = {"wheel_separation": 0.1125, "max_speed": 0.6}


def commands(linear, angular, seconds, start=0.0, rate=10):
    """The same command at 10 Hz, and a zero at the end."""
    return [(start + number / rate, linear, angular) for number in range(round(seconds * rate))] + [
        (start + seconds, 0.0, 0.0)]


@pytest.mark.parametrize("given, options, distance", [
    (commands(0.5, 0.0, 1 / 0.3), {}, 1.0),
    (commands(0.3, 0.0, 1 / 0.3), SI, 1.0),
    (commands(0.3, 0.0, 1 / 0.3, rate=100), {**SI, "acceleration_limit": 1.0}, 1.0 - 0.3 ** 2 / 2),
    (commands(0.5, 0.0, 2.0)[:-1], {}, 0.3 * 2.9),
    (commands(7.0, 0.0, 1.0), {}, 0.6),
], ids=["workshop's units", "SI units", "speeds up gently", "stops a second after the last command", "full power"])
def test_how_far_the_robot_drives(given, options, distance):
    end = judge(METRE, replay(given, METRE, **options)).drive.end
    assert end == pytest.approx((distance, 0.0, 0.0), abs=0.01)


def test_a_turn_in_si_units():
    end = judge(TASKS["quarter"], replay(commands(0.0, math.pi / 2, 1.0), TASKS["quarter"], **SI)).drive.end
    assert end == pytest.approx((0.0, 0.0, math.pi / 2), abs=0.01)


def test_a_wall_stops_the_robot(tmp_path):
    world = tmp_path / "wall.yaml"
    world.write_text("walls: [[[0.5, -1], [0.5, 1]]]")
    task = METRE._replace(world=str(world), penalties=TASKS["park"].penalties)
    twice = commands(0.5, 0.0, 3.0) + commands(-0.5, 0.0, 0.5, start=3.1) + commands(0.5, 0.0, 2.0, start=3.7)
    result = judge(task, replay(twice, task))
    assert result.drive.end.x == pytest.approx(0.5 - FOOTPRINT.right, abs=0.001)
    assert {loss.sentence: loss.points for loss in result.losses}["touched a wall twice"] == 40


def test_the_same_commands_have_the_same_score_whenever_they_were_given():
    drive = commands(0.5, 0.01, 3.0)
    late = [(time + 1.6e9, *command) for time, *command in [(-9.0, 0.0, 0.0), *drive]]
    assert replay(drive, METRE) == replay(drive, METRE)
    assert judge(METRE, replay(late, METRE)).score == pytest.approx(judge(METRE, replay(drive, METRE)).score, abs=0.3)


@pytest.mark.parametrize("hostile", [
    [], [(0.0, 0.0, 0.0)], [(math.nan, 1.0, 1.0), (1.0, math.nan, 0.0), (2.0, math.inf, 0.0)],
    [(number * 1e6, 0.01, 0.0) for number in range(5000)]], ids=["none", "zero", "not finite", "far apart"])
def test_commands_that_move_nothing_are_no_drive(hostile):
    with pytest.raises(NoDrive):
        judge(METRE, replay(hostile, METRE))


@pytest.mark.parametrize("hostile", [
    [(0.0, 1e308, -1e308)], [(5.0, 1.0, 0.0), (4.0, -1.0, 0.0)],
    [(number * 1e-9, 1.0, 0.0) for number in range(100_000)], [(number * 0.9, 1.0, 2.0) for number in range(10_000)]],
    ids=["huge", "backward in time", "dense", "endless"])
def test_wild_commands_are_driven_for_a_bounded_time(hostile):
    samples = replay(hostile, METRE)
    assert samples[-1].time <= 130
    assert 0 <= judge(METRE, samples).score <= 100
