"""Walls stop the simulated robot where it touches them, at any speed, and it can back off."""

import math

import pytest

from jetbot.kinematics import Pose
from simulation.diff_drive import ORIGIN, STEP, Body, DiffDriveModel
from simulation.world import FOOTPRINT, World

WALL = World(walls=(((1.0, -50.0), (1.0, 50.0)),))
TOUCHES = 1e-4  # m


def robot(world, pose=ORIGIN, max_speed=0.6):
    """A robot among the walls of a world."""
    return DiffDriveModel(Body(max_speed=max_speed), pose, world)


def drive(model, left, right, seconds):
    """Drive for so long; return the clearances on the way."""
    for _ in range(round(seconds / STEP)):
        model.step((left, right))
        yield WALL.clearance(model.pose)


def drive_to_wall(model, left=1.0, right=1.0):
    """Drive until a wall stops the robot."""
    for _ in drive(model, left, right, 60):
        if model.touching:
            return
    raise AssertionError(f"no wall up to {model.pose}")


@pytest.mark.parametrize("max_speed", [0.05, 0.6, 5.0, 300.0])
@pytest.mark.parametrize("yaw", [0.0, 0.3, -1.2])
def test_no_robot_is_too_fast_for_a_wall(max_speed, yaw):
    model = robot(WALL, Pose(0.0, 0.0, yaw), max_speed)
    drive_to_wall(model)
    assert 0 < WALL.clearance(model.pose) < TOUCHES
    assert min(drive(model, 1.0, 1.0, 1.0)) > 0  # it pushes on
    assert model.pose.x < 1


def test_a_robot_that_turns_stops_at_the_corner_that_touches():
    model = robot(World(walls=(((0.05, -1.0), (0.05, 1.0)),)))
    drive_to_wall(model, -1.0, 1.0)
    corner = math.atan2(FOOTPRINT.bottom, FOOTPRINT.right)
    assert math.hypot(FOOTPRINT.right, FOOTPRINT.top) * math.cos(model.pose.yaw + corner) == pytest.approx(
        0.05, abs=TOUCHES)


def test_at_a_wall_both_wheels_stop_as_far_as_the_robot_has_driven_and_it_backs_off_at_once():
    model = robot(WALL)
    drive_to_wall(model)
    assert not model.moving and model.velocity == (0, 0)
    assert model.left.distance == model.right.distance == pytest.approx(model.pose.x, abs=1e-9)
    free = robot(World(), model.pose)
    clearances = list(drive(model, -1.0, -1.0, 1.0))
    assert clearances == sorted(clearances) and clearances[0] > TOUCHES
    list(drive(free, -1.0, -1.0, 1.0))
    assert model.pose == pytest.approx(free.pose)


def test_a_contact_lasts_until_the_robot_is_1_cm_away():
    model = robot(WALL)
    drive_to_wall(model)
    assert all(model.touching == (clearance < 0.01) for clearance in drive(model, -0.3, -0.3, 0.5))


def test_it_slides_along_a_wall_that_it_does_not_push():
    beside = World(walls=(((-1.0, FOOTPRINT.top + 0.001), (9.0, FOOTPRINT.top + 0.001)),))
    model, free = robot(beside), robot(World())
    for each in (model, free):
        list(drive(each, 1.0, 1.0, 2.0))
    assert model.pose == pytest.approx(free.pose) and not model.touching


def test_a_robot_that_is_put_onto_a_wall_drives_off():
    model = robot(WALL, Pose(1.0, 0.0, 0.0))
    list(drive(model, 1.0, 1.0, 1.0))
    assert model.pose.x > 1.3 and not model.touching
