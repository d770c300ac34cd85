"""A simulated robot drives as the bytes on a fake bus say, and reports stalls and contacts; its time is whole steps."""

import pytest

from jetbot.fake.motors import Motors
from jetbot.kinematics import Pose
from simulation.diff_drive import DiffDriveModel
from simulation.simulated_robot import SimulatedRobot, StepClock, describe_stall
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


def test_it_drives_as_the_driver_commands(simulate, make_robot):
    robot, simulated = make_robot(board="adafruit"), simulate()
    robot.set_motors(0.4, 0.6)
    simulated.step(2 * SECOND)
    assert simulated.model.velocity == pytest.approx((0.3, 0.2 * 0.6 / 0.1125), rel=1e-3)
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
    simulated.place(Pose(2.0, -0.001, 1.0))
    assert simulated.state == "at x 2.00 m, y 0.00 m, heading 57 deg; left wheel 0.00 m/s, right wheel 0.00 m/s"


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


def test_a_stall_is_reported_once_each_time_it_lasts(simulate, make_robot):
    robot, simulated = make_robot(board="adafruit"), simulate()

    def reports(speed, seconds):
        robot.set_motors(speed, -speed)
        return [sentence for _ in range(round(seconds * SECOND)) for sentence in simulated.step(1)]

    assert reports(0.047, 0.4) == [], "a ramp passes through the dead band"
    assert reports(0.06, 1) == []
    assert reports(0.047, 2) == [STALL]
    assert reports(0.06, 1) == [] and simulated.model.velocity[1] < -0.05
    assert reports(0.047, 2) == [STALL]
    assert simulated.model.velocity == (0, 0)


@pytest.mark.parametrize("duties, fixed_pwm, sentence", [
    ({"left": -0.0469, "right": 0.047}, False, STALL),
    ({"left": -0.0002}, False, STALL.replace("wheels get 4.7 %", "left wheel gets 0.02 %")),
    ({"right": 0.047}, True, "the right wheel gets 4.7 % of full power, too little to turn: raise min_duty")])
def test_the_wheels_and_the_larger_duty_are_named_with_advice(duties, fixed_pwm, sentence):
    assert describe_stall(duties, fixed_pwm) == sentence


def test_each_10_ms_is_a_step_and_the_stamps_are_whole_steps_apart():
    clock = StepClock(START)
    assert [clock.update(START + now * MS) for now in (9, 10, 19, 31, 60, 3065)] == [0, 1, 0, 2, 3, 300]
    assert clock.stamp == START + 3060 * MS
    assert [clock.remaining(START + now * MS, 2) for now in (3060, 3065, 3085)] == [0.02, 0.015, 0.015]


@pytest.mark.parametrize("change", [DAY, -DAY])
def test_no_step_is_due_where_the_clock_is_set_and_the_stamps_follow_it(change):
    clock = StepClock(START + DAY)
    assert [clock.update(START + DAY + change + now * MS) for now in (0, 10)] == [0, 1]
    assert clock.stamp == START + DAY + change + 10 * MS
    assert 0 < clock.remaining(START, 2) <= 0.02
