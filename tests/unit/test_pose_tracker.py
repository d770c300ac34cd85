"""Odometry goes on without a jump, whatever the board's counters do."""

import math

import pytest

from jetbot_ros.pose_tracker import Track


def follow(*counts, period=0.05):
    track = Track()
    for i, count in enumerate(counts):
        track.add(*count, i * period)
    return track


def pose(track):
    return track.x, track.y, math.remainder(track.yaw, 2 * math.pi)


def test_begins_where_the_board_is_and_has_not_moved():
    track = follow((1.5, -0.25, 0.785))
    assert pose(track) == (1.5, -0.25, 0.785)
    assert (track.driven, track.turned, track.recent()) == (0, 0, None)


@pytest.mark.parametrize("counts, expected", [
    (((32.7, 0, 0), (-32.736, 0, 0)), (32.8, 0, 0)),
    (((0, 0, 3.1), (0, 0, -3.1)), (0, 0, -3.1)),                        # a yaw that wraps at pi
    (((0, 0, 32.7), (0, 0, -32.736)), (0, 0, math.remainder(32.8, 2 * math.pi)))])
def test_a_counter_that_wraps(counts, expected):
    track = follow(*counts)
    assert pose(track) == pytest.approx(expected)
    assert track.driven + track.turned < 0.11


@pytest.mark.parametrize("last, first, after", [
    ((1, 2, math.pi / 2), (0, 0, 0), 0.05), ((0.26, 0, 0), (0, 0, 0), 0.05), ((0, 0, 3), (0, 0, 0), 0.05),
    ((0.975, 0, 0), (0.08, 0, 0), 3.0)])
def test_a_board_that_restarts_goes_on_from_there(last, first, after):
    track = Track()
    track.add(*last, 0)
    track.add(*first, after)
    assert pose(track) == pytest.approx(last)
    track.add(first[0] + 0.05, 0, 0, after + 0.05)
    assert track.driven == pytest.approx(0.05)
    assert (track.x - last[0], track.y - last[1]) == pytest.approx((0.05 * math.cos(last[2]), 0.05 * math.sin(last[2])))


def test_driving_home_is_no_restart():
    assert pose(follow(*((0.5 - 0.05 * i, 0, 0) for i in range(11)))) == pytest.approx((0, 0, 0))


def test_speeds_of_a_curve_and_of_driving_backward():
    curve = follow(*((0.01 * i, 0, 0.005 * i) for i in range(9)))
    assert curve.recent() == pytest.approx((0.05, 0.01, 0.005), rel=0.01)
    assert follow(*((0.02 * i, 0, 3.1) for i in range(3))).recent()[1] == pytest.approx(-0.02, rel=0.01)


@pytest.mark.parametrize("count, period", [(2, 0.04), (2, 0.08), (4, 0.2)])
def test_reports_in_bunches_tell_the_same_speed(count, period):
    track = Track()
    for bunch in range(6):
        for i in range(count):
            track.add(0.5 * period * (bunch + i / count), 0, 0, period * bunch + 0.001 * i)
            if bunch > 2:
                seconds, ahead, _ = track.recent()
                assert ahead / seconds == pytest.approx(0.5, rel=0.01)
