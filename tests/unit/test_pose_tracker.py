"""The pose continues without a jump, whatever the board's counters do."""

import math

import pytest

from jetbot_control_node.odometry.pose_tracker import PoseTracker


def track(*counts, period=0.05):
    """A tracker after these counts of x, y in mm and yaw in mrad."""
    tracker = PoseTracker()
    for i, count in enumerate(counts):
        tracker.update(count, i * period)
    return tracker


def pose(tracker):
    return tracker.x, tracker.y, math.remainder(tracker.yaw, 2 * math.pi)


def test_begins_where_the_board_is_and_has_not_moved():
    tracker = track((1500, -250, 785))
    assert pose(tracker) == (1.5, -0.25, 0.785)
    assert (tracker.path_length, tracker.total_rotation, tracker.velocity) == (0, 0, (0, 0))


@pytest.mark.parametrize("counts, expected", [
    (((32700, 0, 0), (-32736, 0, 0)), (32.8, 0, 0)),
    (((0, 0, 3100), (0, 0, -3100)), (0, 0, -3.1)),                        # a yaw that wraps at pi
    (((0, 0, 32700), (0, 0, -32736)), (0, 0, math.remainder(32.8, 2 * math.pi)))])
def test_a_counter_that_wraps(counts, expected):
    tracker = track(*counts)
    assert pose(tracker) == pytest.approx(expected)
    assert tracker.path_length + tracker.total_rotation < 0.11


@pytest.mark.parametrize("last, first, after", [
    ((1000, 2000, 1571), (0, 0, 0), 0.05), ((260, 0, 0), (0, 0, 0), 0.05), ((0, 0, 3000), (0, 0, 0), 0.05),
    ((975, 0, 0), (80, 0, 0), 3.0)])
def test_after_a_restart_of_the_board_the_pose_continues(last, first, after):
    tracker = PoseTracker()
    tracker.update(last, 0)
    tracker.update(first, after)
    x, y, yaw = (count / 1000 for count in last)
    assert pose(tracker) == pytest.approx((x, y, yaw))
    tracker.update((first[0] + 50, 0, 0), after + 0.05)
    assert (tracker.x - x, tracker.y - y) == pytest.approx((0.05 * math.cos(yaw), 0.05 * math.sin(yaw)))


def test_driving_home_is_no_restart():
    assert pose(track(*((500 - 50 * i, 0, 0) for i in range(11)))) == pytest.approx((0, 0, 0))


def test_velocity_of_a_curve_and_of_driving_backward():
    curve = track(*((10 * i, 0, 5 * i) for i in range(9)))
    assert curve.velocity == pytest.approx((0.2, 0.1), rel=0.01)
    assert track(*((20 * i, 0, 3100) for i in range(3))).velocity[0] == pytest.approx(-0.4, rel=0.01)


@pytest.mark.parametrize("count, period", [(2, 0.04), (2, 0.08), (4, 0.2)])
def test_telemetry_in_bursts_gives_the_same_velocity(count, period):
    tracker = PoseTracker()
    for burst in range(6):
        for i in range(count):
            tracker.update((round(500 * period * (burst + i / count)), 0, 0), period * burst + 0.001 * i)
            if burst > 2:
                assert tracker.velocity[0] == pytest.approx(0.5, rel=0.01)
