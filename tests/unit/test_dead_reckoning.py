"""Open-loop odometry against closed forms and the simulated robot, with a clock turned by hand and no master."""

import math

import pytest

from conftest import step_of
from jetbot.fake.motors import wheel_speeds
from jetbot.kinematics import mix
from jetbot_control_node.control.state_machine import Sender
from jetbot_control_node.control.supervisor import Supervisor
from jetbot_control_node.odometry.dead_reckoning import DeadReckoning
from simulation.diff_drive import Body, DiffDriveModel

SEPARATION, MAX_SPEED = 0.1125, 0.6
PUPIL = Sender("/pupil")


def reckoning_of(robot, max_speed=MAX_SPEED, wheel_separation=SEPARATION):
    return DeadReckoning(robot.left_motor, robot.right_motor, max_speed, wheel_separation)


def pose(motion):
    return motion.x, motion.y, motion.yaw


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


def drive(supervisor, linear, angular, start, seconds, follow=lambda now: None):
    """Step as ``run`` would, for a command that is repeated; return the end."""
    now = start
    while now < start + seconds:
        supervisor.state = supervisor.state.command(*mix(linear, angular, SEPARATION, MAX_SPEED), PUPIL, now)
        now = min(supervisor.step(now, woken=True), now + 0.05, start + seconds)
        follow(now)
    return now


@pytest.mark.parametrize("reports", [3, 300])
@pytest.mark.parametrize("linear, angular", [(0.5, 0.0), (-0.3, 0.0), (0.5, 0.1), (0.2, -1.5), (-0.3, 0.7), (0, 2.0)])
def test_drives_the_exact_arc_of_what_the_wheels_are_given(robot, reckoning, linear, angular, reports):
    robot.set_motors(*mix(linear, angular, SEPARATION, MAX_SPEED))
    for i in range(reports + 1):
        reckoning(step_of(robot.duties, 7.0 + 2.0 * i / reports))
    yaw = angular * 2.0
    x = linear / angular * math.sin(yaw) if angular else linear * 2.0
    y = linear / angular * (1 - math.cos(yaw)) if angular else 0.0
    motion = reckoning.motion
    assert pose(motion) == pytest.approx((x, y, math.remainder(yaw, 2 * math.pi)), abs=1e-9)
    assert motion.velocity == pytest.approx((linear, angular))
    assert (motion.path_length, motion.total_rotation) == pytest.approx((2 * abs(linear), 2 * abs(angular)))


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


def test_the_wheels_roll_as_far_as_the_robot(robot, reckoning):
    robot.set_motors(0.5, -1.0)
    reckoning(step_of(robot.duties, 0.0))
    reckoning(step_of(robot.duties, 1.0))
    angles, rates = reckoning.motion.joints
    assert angles == rates == pytest.approx((0.3 / 0.03, -0.6 / 0.03))


def test_a_square_of_four_metres_ends_where_the_simulated_robot_does(supervisor, reckoning, folder):
    model, now = DiffDriveModel(Body(dead_band=0.0)), 0.0

    def follow(until):
        model.step(wheel_speeds(folder), until - follow.at)
        follow.at = until
    follow.at = now
    for _ in range(4):
        now = drive(supervisor, 0.4, 0.0, now, 1.0 / 0.4, follow)
        now = drive(supervisor, 0.0, 2.0, now, math.pi / 4, follow)
    drive(supervisor, 0.0, 0.0, now, 1.0, follow)
    assert model.left.distance + model.right.distance == pytest.approx(8.0, abs=0.01)
    assert math.dist(pose(reckoning.motion)[:2], model.pose[:2]) < 0.02 * 4
    assert abs(math.remainder(reckoning.motion.yaw - model.pose.yaw, math.tau)) < 0.02


@pytest.mark.parametrize("stop", [
    lambda supervisor, folder, monkeypatch: None,  # no further command
    lambda supervisor, folder, monkeypatch: (folder / "0x60").unlink(),
    lambda supervisor, folder, monkeypatch: monkeypatch.setattr(type(supervisor.robot), "guarded", False),
    lambda supervisor, folder, monkeypatch: (supervisor.end(), supervisor.run())],
    ids=["time-out", "no board", "no guard", "the end of the node"])
def test_whatever_stops_the_wheels_stops_the_odometry(supervisor, reckoning, folder, monkeypatch, stop):
    now = drive(supervisor, 0.4, 0.0, 0.0, 1.0)
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
