"""calibrate.py: the boards that it tries, the motions that it ends, and the file that it writes."""

import contextlib
import os
import runpy
from unittest.mock import MagicMock, PropertyMock

import pytest
import yaml

from conftest import TOOLS
from jetbot import JetbotError
from jetbot.connection import lock_board
from jetbot.fake.bus import power_on
from jetbot_control_node.parameters import PARAMETERS, checked
from jetbot_tools.calibration import wizard
from jetbot_tools.calibration.motions import WheelStep
from jetbot_tools.calibration.settings import as_yaml, output_file, write
from jetbot_tools.calibration.wizard import Wizard
from jetbot_tools.doctor.motor_board import check_board

calibrate = runpy.run_path(str(TOOLS / "scripts/calibrate.py"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    return tmp_path


def test_says_how_to_undo_it_and_that_works(home, capsys):
    file = home / "a b.yaml"
    file.write_text("old")
    file.with_name("link").symlink_to(file)
    write(home / "link", "new", "")
    assert file.read_text() == "new"
    os.system(capsys.readouterr().out.partition("To undo it: ")[2].partition("\n")[0])
    assert file.read_text() == "old" and (home / "link").is_symlink()


def test_a_file_that_cannot_be_written_is_refused_before_any_question(home):
    (home / "file").touch()
    with pytest.raises(JetbotError, match=r"file/x cannot be written: File exists. Name another with --output.$"):
        output_file(home / "file/x", False)


def test_a_simulated_robot_is_not_written_to_the_real_ones_file_by_another_name(home):
    (home / "link.yaml").symlink_to("jetbot.yaml")
    for name in ("jetbot.yaml", "link.yaml"):
        with pytest.raises(JetbotError, match="is for the real robot, and this one is simulated"):
            output_file(home / name, True)


def test_the_file_holds_the_parameters_and_explains_them():
    parameters = {"board": "waveshare", "i2c_bus": "1", "swap_motors": True, "left_motor_alpha": 0.95, "min_duty": 0.1}
    text = as_yaml(parameters)
    assert checked(yaml.safe_load(text)) == {**checked({}), **parameters}
    assert f"min_duty: 0.1  # {PARAMETERS['min_duty'].doc}\n" in text


@pytest.mark.parametrize("measured, words", [
    ({"max_speed": 0.6, "wheel_separation": 0.11}, "angular.z in rad/s"), ({}, ""),
    ({"max_speed": 0.6}, "angular.z is not in rad/s")])
def test_the_file_says_whether_commands_are_metres_and_radians(measured, words):
    assert words in as_yaml(measured) and ("rad/s" in as_yaml(measured)) == bool(words)


def test_finds_a_board_at_another_address_and_calibrates_it_there(home, folder, monkeypatch):
    seen = []
    place = {"i2c_bus": f"fake:{folder}", "port": ""}
    lock_board(place["i2c_bus"], 0x61).close()  # a fake bus is made with a chip there
    monkeypatch.setattr("builtins.input", lambda question: "")
    monkeypatch.setattr(Wizard, "find_motors", lambda wizard: seen.append(wizard.parameters))
    boards = calibrate["find_boards"](0x61, **place)
    assert "adafruit" in boards and "sparkfun" not in boards
    with pytest.raises(JetbotError, match="No wheel turned"):
        calibrate["calibrate"](["adafruit"], 0x61, **place)
    assert seen == [{"board": "adafruit", **place, "i2c_address": 0x61, "pwm_frequency": 50}]


@pytest.mark.parametrize("boards, answers, driven", [
    (["waveshare_hat"], ["yes"], ["waveshare_hat"]), (["waveshare_hat"], ["no"], []),
    (["adafruit", "waveshare_hat"], [], ["adafruit"])])
def test_what_may_be_a_servo_board_is_driven_only_if_a_person_says_it_is_none(folder, monkeypatch, boards, answers,
                                                                              driven):
    power_on(folder)
    checks = {board: check_board(board, f"fake:{folder}", "") for board in boards}
    monkeypatch.setattr("builtins.input", lambda question: answers.pop() if "no servo board?" in question else None)
    assert calibrate["drivable"](checks) == driven
    assert not answers


@pytest.mark.parametrize("board, frequency", [("jetbot", 50), ("waveshare_hat", 50), ("sparkfun", None)])
def test_a_pca9685_drives_at_a_frequency_at_which_motors_start_early(board, frequency):
    assert Wizard(board=board).parameters.get("pwm_frequency") == frequency


@pytest.mark.parametrize("guarded, late, ends_at", [
    ([True, True], 0.0, None), ([True, False], 0.0, 1), ([True, True], 1.0, 0)])
def test_a_motion_ends_when_the_guard_is_lost_or_the_program_was_held_up(monkeypatch, guarded, late, ends_at):
    robot, clock = MagicMock(), [0.0]
    robot.__enter__.return_value = robot
    type(robot).guarded = PropertyMock(side_effect=guarded)

    def no_key(timeout):
        clock[0] += timeout + late

    monkeypatch.setattr(wizard, "Robot", lambda **_: robot)
    monkeypatch.setattr(wizard, "single_keys", contextlib.nullcontext)
    monkeypatch.setattr(wizard, "key_pressed", no_key)
    monkeypatch.setattr(wizard.time, "monotonic", lambda: clock[0])
    monkeypatch.setattr("builtins.input", lambda question: "")
    motion = [WheelStep(0.1, 0.1), WheelStep(0.2, 0.2)]
    assert Wizard(board="jetbot").drive_until_key("", motion) == (None if ends_at is None else motion[ends_at])


@pytest.mark.parametrize("ahead, turned, wiring", [
    ("forward", "right", (False, False, False)), ("backward", "left", (False, True, True)),
    ("forward", "left", (True, False, False)), ("backward", "right", (True, True, True))])
def test_a_jetbot_pro_is_asked_how_the_robot_moved(monkeypatch, ahead, turned, wiring):
    answers = iter([ahead, turned])
    monkeypatch.setattr("builtins.input", lambda question: next(answers))
    pro = wizard.wizard_for("jetbot_pro")
    monkeypatch.setattr(pro, "drive_until_key", lambda announcement, motion: None)
    assert pro.find_motors()
    assert tuple(pro.parameters[name] for name in ("swap_motors", "invert_left", "invert_right")) == wiring
