"""The motors follow their chip's file at once, and do not read it again while it has not changed."""

import os
import time

import pytest

from jetbot import Robot
from jetbot.fake import motors as module
from jetbot.fake.bus import power_on
from jetbot.fake.motors import CLOCK_TICK, STOPPED, Motors
from jetbot.wait import wait_until


@pytest.fixture
def robot(folder):
    with Robot("adafruit", f"fake:{folder}", guard=False) as robot:
        yield robot


@pytest.fixture
def motors(robot, folder):
    return Motors(folder)


def age(file):
    """Let a file be older than the clock's tick."""
    os.utime(file, (time.time() - 2 * CLOCK_TICK,) * 2)


def near(speed):
    return pytest.approx((speed, speed), abs=0.0003)


def test_a_file_that_has_not_changed_is_read_once(motors, folder, monkeypatch):
    reads = []
    read_chip = module.read_chip
    monkeypatch.setattr(module, "read_chip", lambda *arguments: reads.append(arguments) or read_chip(*arguments))
    age(folder / "0x60")
    for _ in range(10):
        assert motors.speeds() == STOPPED
    assert len(reads) == 1


def test_the_second_of_two_writes_within_a_tick_of_the_clock_counts(motors, robot, folder):
    robot.forward(0.5)
    written = os.stat(folder / "0x60").st_mtime_ns
    assert motors.speeds() == near(0.5)
    robot.stop()
    os.utime(folder / "0x60", ns=(written, written))
    assert motors.speeds() == STOPPED


def test_a_chip_that_is_unplugged_turns_no_wheel_until_it_is_back(motors, robot, folder):
    robot.forward(0.5)
    age(folder / "0x60")
    assert motors.speeds() == near(0.5)
    os.rename(folder / "0x60", folder / "unplugged")
    assert (motors.speeds(), motors.pwm_frequency()) == (STOPPED, None)
    os.rename(folder / "unplugged", folder / "0x60")
    assert motors.speeds() == near(0.5)
    power_on(folder)
    assert motors.speeds() == STOPPED


def test_the_timer_of_a_chip_that_is_not_fed_runs_off_while_its_file_does_not_change(folder):
    with Robot("sparkfun", f"fake:{folder}", guard=False) as robot:
        robot.forward(0.5)
        robot.keep_alive()  # arms the timer
        motors = Motors(folder, "sparkfun")
        assert motors.speeds() == pytest.approx((0.5, 0.5), abs=0.01)
        assert wait_until(lambda: motors.speeds() == STOPPED, 5.0)
