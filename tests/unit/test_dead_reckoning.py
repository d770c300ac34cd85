"""Open-loop odometry against the simulated robot, with a clock turned by hand and no master."""

from random import Random

import pytest

from conftest import step_of
from jetbot.kinematics import mix
from jetbot_control_node.control.state_machine import STOPPED, Sender
from jetbot_control_node.control.supervisor import Supervisor
from jetbot_control_node.odometry.dead_reckoning import DeadReckoning
from simulation.diff_drive import Body, DiffDriveModel

SEPARATION, MAX_SPEED = 0.1125, 0.6
PUPIL = Sender("/pupil")


def reckoning_of(robot):
    return DeadReckoning(robot.left_motor, robot.right_motor, MAX_SPEED, SEPARATION)


@pytest.fixture
def robot(make_robot):
    return make_robot()


@pytest.fixture
def reckoning(robot):
    return reckoning_of(robot)


@pytest.fixture
def supervisor(robot, reckoning):
    supervisor = Supervisor(robot, 1.0)
    supervisor.watchers.append(reckoning)
    return supervisor


def drive(supervisor, linear, seconds):
    """Step as ``run`` would, for a command that is repeated; return the end."""
    now = 0.0
    while now < seconds:
        supervisor.state = supervisor.state.command(*mix(linear, 0.0, SEPARATION, MAX_SPEED), PUPIL, now)
        now = min(supervisor.step(now, woken=True), now + 0.05, seconds)
    return now


def test_it_is_where_an_ideal_robot_is_whose_wheels_are_given_the_same(robot, reckoning):
    numbers, now, path, rotation = Random(1), 0.0, 0.0, 0.0
    model = DiffDriveModel(Body(motor_lag=0.0, dead_band=0.0))
    for _ in range(200):
        robot.set_motors(*numbers.choice([STOPPED, (0.5, 0.5), (numbers.uniform(-1, 1), numbers.uniform(-1, 1))]))
        reckoning(step_of(robot.duties, now))
        elapsed = numbers.choice([0.001, 0.05, 0.4])
        now += elapsed
        model.step(robot.duties, elapsed)
        path, rotation = (total + abs(speed) * elapsed for total, speed in zip((path, rotation), model.velocity))
        motion = reckoning.motion.advance(now)
        assert (motion.x, motion.y, motion.yaw) == pytest.approx(model.pose, abs=1e-9)
        assert motion.velocity == pytest.approx(model.velocity)
        assert motion.joints == (pytest.approx(model.joints[0]), pytest.approx(model.joints[1]))
        assert (motion.path_length, motion.total_rotation) == pytest.approx((path, rotation))


@pytest.mark.parametrize("options, speeds, duties", [
    ({}, (0.5, 3.0), (0.5, 1.0)), ({"min_duty": 0.2}, (-0.1, 0), (-0.28, 0)),
    ({"left_motor_alpha": 0.9}, (0.3, -0.6), (0.3, -0.6)),
    ({"swap_motors": True, "invert_left": True}, (0.3, -0.6), (0.3, -0.6)),
    ({"right_motor_alpha": 0.8, "invert_right": True}, (0.3, -0.6), (0.3, -0.6))])
def test_the_wheels_turn_by_what_they_are_given_whatever_their_trim_and_wiring(make_robot, options, speeds, duties):
    robot = make_robot(**options)
    reckoning = reckoning_of(robot)
    robot.set_motors(*speeds)
    reckoning(step_of(robot.duties, 0.0))
    assert reckoning.motion.speeds == pytest.approx(tuple(duty * MAX_SPEED for duty in duties))


@pytest.mark.parametrize("stop", [
    lambda supervisor, folder, monkeypatch: None,  # no further command
    lambda supervisor, folder, monkeypatch: (folder / "0x60").unlink(),
    lambda supervisor, folder, monkeypatch: monkeypatch.setattr(type(supervisor.robot), "guarded", False),
    lambda supervisor, folder, monkeypatch: (supervisor.end(), supervisor.run())],
    ids=["time-out", "no board", "no guard", "the end of the node"])
def test_whatever_stops_the_wheels_stops_the_odometry(supervisor, reckoning, folder, monkeypatch, stop):
    now = drive(supervisor, 0.4, 1.0)
    stop(supervisor, folder, monkeypatch)
    end = now + 1.2
    while now < end and not supervisor.closed:
        now = supervisor.step(now, woken=False)
    assert not reckoning.motion.moving
    assert 0.39 < reckoning.motion.x < 0.4 * 2.2


def test_after_a_freeze_only_what_the_guard_allows_counts(robot, reckoning):
    robot.forward(0.5)
    reckoning(step_of(robot.duties, 0.0))
    thawed = reckoning.motion.advance(60.0)
    assert not thawed.moving
    assert thawed.x == pytest.approx(0.3 * 1.0)  # the guard has stopped it after a second
