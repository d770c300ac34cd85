"""A simulated robot drives as the bytes on a fake bus say, and reports stalls and contacts; its time is whole steps."""

import pytest

from jetbot.fake.motors import Motors
from jetbot.kinematics import Pose
from simulation.diff_drive import DiffDriveModel
from simulation.simulated_robot import MAX_STEPS, SimulatedRobot, StallReport, StepClock
from simulation.world import FOOTPRINT, World

SECOND = 100  # steps
MS = 1_000_000
START = 5_000 * MS
DAY = 86_400_000 * MS
WALL = World(walls=(((0.1 + FOOTPRINT.right, -1.0), (0.1 + FOOTPRINT.right, 1.0)),))
STALL = "the wheels get 4.7 % of full power, too little to turn: raise min_duty, or lower pwm_frequency"


@pytest.fixture
def simulate(folder):
    """Makes a simulated robot whose motors are on the test's fake bus."""
    return lambda **options: SimulatedRobot(Motors(folder), DiffDriveModel(**options))


@pytest.mark.parametrize("swap_motors, side", [(False, 1), (True, -1)])
def test_a_driver_with_swapped_wheels_turns_it_the_other_way(simulate, make_robot, swap_motors, side):
    robot, simulated = make_robot(board="adafruit", swap_motors=swap_motors), simulate()
    robot.set_motors(0.4, 0.6)
    simulated.step(2 * SECOND)
    assert simulated.model.velocity == pytest.approx((0.3, side * 0.2 * 0.6 / 0.1125), rel=1e-3)
    robot.stop()
    simulated.step(2 * SECOND)
    assert simulated.model.velocity == (0, 0)


def test_put_back_while_it_rolls_it_is_at_its_start_and_stays_there(simulate, make_robot):
    start = Pose(1.0, 0.0, 0.5)
    robot, simulated = make_robot(board="adafruit"), simulate(pose=start)
    robot.set_motors(1.0, 0.9)
    simulated.step(SECOND)
    robot.stop()
    simulated.place()
    simulated.step(SECOND)
    assert simulated.model.pose == start
    simulated.place(Pose(2.0, -3.0, 1.0))
    assert simulated.state == ("at x 2.00 m, y -3.00 m, heading 57 deg; "
                               "left wheel 0.00 m/s, right wheel 0.00 m/s")


def test_its_state_has_no_minus_zero(simulate):
    assert simulate(pose=Pose(-0.001, 0.0, 0.0)).state.startswith("at x 0.00 m, ")


def test_a_contact_is_reported_once_and_the_world_of_the_start_returns(simulate, make_robot):
    robot, simulated = make_robot(board="adafruit"), simulate(world=WALL)
    robot.set_motors(0.5, 0.5)
    sentences = [simulated.step(1) for _ in range(SECOND)]
    assert [each for each in sentences if each] == [["touched a wall"]]
    assert simulated.model.pose.x == pytest.approx(0.1, abs=1e-4)
    simulated.enter(World())
    simulated.step(SECOND)
    assert simulated.model.pose.x > 0.3
    simulated.enter()
    assert simulated.model.world == WALL


def test_a_stall_is_reported_once_with_advice(simulate, make_robot):
    robot, simulated = make_robot(board="adafruit"), simulate()
    robot.set_motors(0.047, -0.047)
    assert [sentence for _ in range(2 * SECOND) for sentence in simulated.step(1)] == [STALL]
    assert simulated.model.velocity == (0, 0)
    robot.set_motors(0.06, -0.06)
    assert simulated.step(SECOND) == []
    assert simulated.model.velocity[1] < -0.05


def reports(*moments, fixed_pwm=False):
    """Return what is reported of each of these, (seconds, left duty, right duty), one after the other; 0: no stall."""
    report = StallReport()
    return [report.update({name: duty for name, duty in (("left", left), ("right", right)) if duty}, fixed_pwm, seconds)
            for seconds, left, right in moments]


@pytest.mark.parametrize("left, right, sentence", [
    (-0.5 * 0.1125 / 2 / 0.6, 0.5 * 0.1125 / 2 / 0.6, STALL),
    (-0.0002, 0, STALL.replace("wheels get 4.7 %", "left wheel gets 0.02 %")),
    (0, 0.04, STALL.replace("wheels get 4.7 %", "right wheel gets 4 %"))])
def test_the_wheels_and_the_larger_duty_are_named(left, right, sentence):
    assert reports((1.0, left, right)) == [sentence]


def test_a_frequency_that_is_fixed_is_no_advice():
    assert reports((1.0, 0.04, 0), fixed_pwm=True)[0].endswith("too little to turn: raise min_duty")


def test_a_stall_is_reported_again_when_it_returns_or_another_wheel_stalls_too():
    stall = 1.0, 0.047, 0.047
    assert reports(stall, (1.0, 0.03, 0.03), (1.0, 0, 0), stall) == [STALL, None, None, STALL]
    assert reports((1.0, 0.047, 0), stall)[-1] == STALL


def test_a_ramp_that_passes_through_the_dead_band_is_no_stall():
    assert reports((0.4, 0.01, 0.04), (0.1, 0, 0), (0.4, 0.01, 0.01)) == [None] * 3


def test_each_10_ms_is_a_step_and_the_stamps_are_whole_steps_apart():
    clock = StepClock(START, DAY)
    assert [clock.update(START + now * MS, DAY + now * MS) for now in (9, 10, 19, 31, 60)] == [0, 1, 0, 2, 3]
    assert (clock.steps, clock.stamp) == (6, DAY + 60 * MS)


def test_the_loop_waits_for_whole_steps_since_the_start():
    clock = StepClock(START + 7 * MS, DAY)
    assert [clock.remaining(START + now * MS, 2) for now in (7, 8, 26, 27)] == [0.02, 0.019, 0.001, 0.02]


def test_a_pause_is_made_up_for_in_parts():
    clock = StepClock(START, DAY)
    parts = [clock.update(START + 2505 * MS, DAY + 2505 * MS) for _ in range(4)]
    assert parts == [MAX_STEPS, MAX_STEPS, 50, 0]
    assert clock.stamp == DAY + 2500 * MS


@pytest.mark.parametrize("change", [DAY, -DAY // 2])
def test_the_stamps_follow_a_clock_that_is_set_and_no_small_difference(change):
    clock = StepClock(START, DAY)
    clock.update(START + 10 * MS, DAY + 900 * MS)
    assert clock.stamp == DAY + 10 * MS
    clock.update(START + 20 * MS, DAY + change)
    assert clock.stamp == DAY + change
    clock.update(START + 30 * MS, DAY + change + 11 * MS)
    assert clock.stamp == DAY + change + 10 * MS
