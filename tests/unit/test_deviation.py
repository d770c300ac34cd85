"""How uncertain the pose becomes that a robot adds up, by a board that measures and by one that does not."""

import math

import pytest

from jetbot_control_node.odometry import dead_reckoning, pose_tracker
from jetbot_control_node.odometry.dead_reckoning import Motion
from jetbot_control_node.odometry.motion import MAX_YAW, RESOLUTION, Deviation
from jetbot_control_node.odometry.pose_tracker import PoseTracker

AHEAD, TURN = (1.0, 0.0), (0.0, math.pi / 2)


def measured(steps):
    """The deviation after these steps (m straight ahead, rad on the spot), as a JetBot Pro counts them."""
    tracker, x, y, yaw = PoseTracker(), 0.0, 0.0, 0.0
    tracker.update((0, 0, 0), 0.0)
    for now, (forward, turn) in enumerate(steps, 1):
        x, y, yaw = x + forward * math.cos(yaw), y + forward * math.sin(yaw), yaw + turn
        tracker.update((round(1000 * x), round(1000 * y), round(1000 * math.remainder(yaw, math.tau))), now)
    return tracker.deviation


def reckoned(steps):
    """The same for a board that measures nothing, at 0.1 m/s and 0.1 rad/s."""
    motion = Motion(wheel_separation=2.0)
    for forward, turn in steps:
        motion = motion._replace(speeds=(0.1 if forward else -0.1, 0.1))
        for _ in range(round((forward + turn) / 0.1 / 0.05)):
            motion = motion.advance(motion.at + 0.05)
    return motion.deviation


@pytest.fixture(params=[(measured, pose_tracker.DRIFT), (reckoned, dead_reckoning.DRIFT)],
                ids=["measured", "from what the wheels are given"])
def robot(request):
    """What returns a robot's deviation after some steps, and its drift."""
    return request.param


def test_a_straight_path_adds_the_drift(robot):
    deviation, drift = robot
    assert deviation([AHEAD] * 3).position == pytest.approx(3 * drift, rel=0.03)


def test_a_turn_on_the_spot_makes_only_the_heading_uncertain(robot):
    deviation, drift = robot
    before, after = deviation([AHEAD]), deviation([AHEAD] + [TURN] * 4)
    assert after.position == pytest.approx(before.position, abs=0.002)
    assert after.yaw == pytest.approx(drift * math.tau + RESOLUTION, rel=0.03)


def test_each_side_of_a_square_is_as_uncertain_as_the_heading_in_which_it_is_driven(robot):
    deviation, drift = robot
    sides = [math.hypot(drift, RESOLUTION + drift * i * math.pi / 2) for i in range(4)]
    assert deviation(([AHEAD, TURN] * 4)[:-1]).position == pytest.approx(sum(sides), rel=0.03)


def test_a_heading_and_a_path_cannot_be_more_than_wholly_uncertain():
    lost = Deviation(0.1).grow(0.0, 1000.0)
    assert lost.yaw == MAX_YAW
    assert lost.grow(-2.0, 0.0).position == pytest.approx(2.0 + RESOLUTION)
