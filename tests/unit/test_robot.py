"""The two wheels of a Robot: speeds, trim, wiring, and what is refused."""

import math

import pytest

from conftest import registers
from jetbot import BusError, InvalidValue, JetbotError, Robot
from jetbot.boards.pwm_motors import PwmMotors
from jetbot.errors import GuardError
from jetbot.fake.motors import wheel_speeds


@pytest.mark.parametrize("action, left, right", [
    (lambda robot: robot.set_motors(0.3, -0.6), 0.3, -0.6),
    (lambda robot: robot.forward(), 1, 1),
    (lambda robot: robot.forward(0.4), 0.4, 0.4),
    (lambda robot: robot.backward(speed=0.4), -0.4, -0.4),
    (lambda robot: robot.left(0.3), -0.3, 0.3),
    (lambda robot: robot.right(0.3), 0.3, -0.3),
    (lambda robot: robot.stop(), 0, 0),
    (lambda robot: setattr(robot.left_motor, "value", 0.7), 0.7, -0.2),
    (lambda robot: setattr(robot.right_motor, "value", -0.7), 0.2, -0.7),
])
def test_wheels_turn_at_the_speed_that_is_set(make_robot, folder, action, left, right):
    robot = make_robot()
    robot.set_motors(0.2, -0.2)
    action(robot)
    assert wheel_speeds(folder) == pytest.approx((left, right), abs=0.0003)
    assert (robot.left_motor.value, robot.right_motor.value) == (left, right)


@pytest.mark.parametrize("options, speeds, wheels", [
    ({}, (5, -5), (1, -1)),
    ({"left_motor_alpha": 0.5, "right_motor_alpha": 2}, (0.8, 0.6), (0.4, 1)),
    ({"left_motor_alpha": 0.5}, (1.5, 1.5), (0.75, 1)),  # the trim comes before saturation
    ({"invert_right": True}, (0.3, -0.6), (0.3, 0.6)),
    ({"swap_motors": True, "invert_left": True}, (0.3, -0.6), (-0.6, -0.3)),
    ({"min_duty": 0.2}, (0, 0.001), (0, 0.2008)),
    ({"min_duty": 0.2}, (1, -1), (1, -1)),
    ({"max_duty": 0.5}, (1, -0.5), (0.5, -0.25)),
    ({"min_duty": 0.2, "max_duty": 0.6}, (0.5, -1), (0.4, -0.6)),
    ({"min_duty": 0.2}, (0.1 + 0.2 - 0.3, 0.3 - 0.1 - 0.2), (0, 0)),
])
def test_saturation_trim_wiring_and_dead_band(make_robot, folder, options, speeds, wheels):
    make_robot(**options).set_motors(*speeds)
    assert wheel_speeds(folder) == pytest.approx(wheels, abs=0.0003)


@pytest.mark.parametrize("speeds, sent", [
    ((-0.5, 1.5), (-0.5, 1.5)), ((-2.0, 2.0), (-2.0, 2.0)), ((1e308, 1e308), (32.767, 32.767))])
def test_a_jetbot_pro_saturates_only_where_its_frames_end(make_robot, folder, speeds, sent):
    trims = {"min_duty": 0.1, "max_duty": 0.5, "left_motor_alpha": 0.9}  # of duties, which this board controls itself
    make_robot(board="jetbot_pro", port=f"fake:{folder}", **trims).set_motors(*speeds)
    assert wheel_speeds(folder, "jetbot_pro") == sent


@pytest.mark.parametrize("options, speeds, cut_off", [
    ({}, (1.0, 1.2), True), ({}, (-1.5, -1.2), True), ({}, (1.2, 1.2), True), ({}, (1.0, 1.0), False),
    ({}, (0.9, 1.2), False), ({}, (-1.2, 1.5), False), ({"left_motor_alpha": 0.5}, (1.2, 1.5), False),
    ({"min_duty": 0.3, "invert_left": True}, (1.2, 1.5), True), ({"max_duty": 0.5}, (1.2, 1.5), True),
    ({"board": "jetbot_pro"}, (40, 50), False)])
def test_a_command_that_full_power_cuts_off(make_robot, folder, options, speeds, cut_off):
    robot = make_robot(port=f"fake:{folder}", **options)
    robot.set_motors(*speeds)
    assert robot.at_full_power == cut_off


@pytest.mark.parametrize("action, speed", [
    ("forward", math.nan), ("backward", -math.inf), ("left", "fast"), ("right", None), ("forward", 10 ** 400)])
def test_what_is_no_speed_is_refused_and_stops(make_robot, folder, action, speed):
    robot = make_robot()
    robot.forward(0.5)
    with pytest.raises(ValueError, match="^A speed must be a finite number, not "):
        getattr(robot, action)(speed)
    assert wheel_speeds(folder) == (0, 0)


@pytest.mark.parametrize("alpha", [math.nan, math.inf, "1.0", None, True])
def test_what_is_no_alpha_is_refused(make_robot, folder, alpha):
    robot = make_robot()
    for refused in (lambda: make_robot(left_motor_alpha=alpha), lambda: setattr(robot.right_motor, "alpha", alpha)):
        with pytest.raises(ValueError, match="^An alpha must be a number, not "):
            refused()
    robot.forward(0.5)
    assert wheel_speeds(folder) == (0.5, 0.5)


def test_a_new_robot_takes_over_from_the_old_one_which_is_closed(make_robot, folder):
    old = make_robot()
    old.set_motors(0.5, -0.5)
    new = make_robot()
    assert wheel_speeds(folder) == (0, 0)
    for action in old.forward, old.keep_alive:
        with pytest.raises(JetbotError, match="^This robot is closed."):
            action()
    old._guard.heartbeat.assert_not_called()  # a new guard would stop the next robot
    new.forward(0.25)
    old.close()
    assert wheel_speeds(folder) == (0.25, 0.25)
    new.close()
    new.close()
    assert wheel_speeds(folder) == (0, 0)


def test_a_robot_whose_guard_cannot_start_releases_its_board(folder, monkeypatch):
    closed = []
    monkeypatch.setattr(PwmMotors, "close", lambda driver: closed.append(driver))
    monkeypatch.setenv("JETBOT_GUARD", str(folder / "nobody"))
    with pytest.raises(GuardError):
        Robot(i2c_bus=f"fake:{folder}")
    assert closed


def test_a_board_that_is_gone_at_close_is_reported(make_robot, folder):
    robot = make_robot()
    robot.forward()
    (folder / "0x60").unlink()
    with pytest.raises(BusError):
        robot.close()


def test_defaults_come_from_the_environment(make_robot, folder, monkeypatch):
    monkeypatch.setenv("JETBOT_BOARD", "waveshare")
    monkeypatch.setenv("JETBOT_I2C_BUS", f"fake:{folder}")
    make_robot(i2c_bus=None).forward()
    assert wheel_speeds(folder, "waveshare") == (1, 1)
    assert wheel_speeds(folder, "adafruit") == (0, 0)


def test_a_board_at_another_address_and_pwm_frequency(make_robot, folder):
    with make_robot(i2c_address="0x61", pwm_frequency=50) as robot:
        robot.set_motors(0.5, -0.5)
        assert wheel_speeds(folder, "adafruit", 0x61) == (0.5, -0.5)
        assert registers(folder, 0x61)[0xFE] == 121
    assert wheel_speeds(folder, "adafruit", 0x61) == (0, 0)


@pytest.mark.parametrize("name, value, sentence", [
    ("min_duty", 1, "The min_duty must be a number of at least 0 and below 1, not 1."),
    ("max_duty", 1.5, "The max_duty must be a number above 0, 1 at most, not 1.5."),
    ("pwm_frequency", 2000, "The pwm_frequency must be a number from 24 to 1526, not 2000."),
    ("i2c_address", "0x78", "The I2C address must be an address from 0x03 to 0x77, not '0x78'."),
    ("swap_motors", "false", "The option swap_motors must be true or false, not 'false'."),
    ("invert_left", 1, "The option invert_left must be true or false, not 1.")])
def test_an_option_that_cannot_be(make_robot, folder, name, value, sentence):
    with pytest.raises(InvalidValue) as error:
        make_robot(**{name: value})
    assert str(error.value) == sentence
    assert not folder.exists(), "the board is not touched"
