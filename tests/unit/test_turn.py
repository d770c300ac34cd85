"""Lesson 3's exercise: one sentence for each command that does not turn the robot on the spot, right and slowly."""

import pytest

from jetbot_lessons.turn import check_command


@pytest.mark.parametrize("x, z, problem", [
    (0.5, 0.0, "has linear.x 0.5, so the robot drives forward: leave linear.x at 0"),
    (-0.5, -0.05, "has linear.x -0.5, so the robot drives backward: leave linear.x at 0"),
    (0.0, 0.05, "has angular.z 0.05, which turns the robot to the left: write a number below 0"),
    (0.0, 0.0, "has angular.z 0, which turns no wheel: write -0.01 or less"),
    (0.0, -0.001, "has angular.z -0.001, which turns no wheel: write -0.01 or less"),
    (0.0, -0.5, "has angular.z -0.5, which is fast: write a number between -0.2 and 0"),
    (float("nan"), -0.05, "has linear.x nan and angular.z -0.05: write numbers")])
def test_wrong_command(x, z, problem):
    assert check_command(x, z).startswith(f"Your command {problem}")


@pytest.mark.parametrize("z", [-0.01, -0.05, -0.2])
def test_right_command(z):
    assert check_command(0.0, z) is None
