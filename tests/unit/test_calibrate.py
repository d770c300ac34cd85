"""The file that calibrate.py writes."""

import contextlib
import os
import runpy
from unittest.mock import MagicMock, PropertyMock

import pytest

from conftest import TOOLS
from jetbot import JetbotError
from jetbot.fake.bus import power_on
from jetbot.lock import lock_board
from jetbot_tools.motions import Step
from jetbot_tools.probe import check_board
from jetbot_tools.wizard import Wizard

calibrate = runpy.run_path(str(TOOLS / "scripts/calibrate.py"))


@pytest.fixture
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_HOME", str(tmp_path))
    return tmp_path


def test_says_how_to_undo_it_and_that_works(home, capsys):
    file = home / "a b.yaml"
    file.write_text("old")
    file.with_name("link").symlink_to(file)
    calibrate["write"](home / "link", "new")
    assert file.read_text() == "new"
    os.system(capsys.readouterr().out.partition("To undo it: ")[2].partition("\n")[0])
    assert file.read_text() == "old" and (home / "link").is_symlink()


@pytest.mark.parametrize("name, make, reason", [
    ("fifo", os.mkfifo, "not a regular file"), ("folder", os.mkdir, "not a regular file"),
    ("large", lambda file: file.touch() or os.truncate(file, 50 * 10**9), "larger than 64 kB"),
    ("loop", lambda file: file.symlink_to(file), "Too many levels of symbolic links"),
    ("link", lambda file: file.symlink_to("no/file"), "No such file or directory"),
    ("file/x", lambda file: file.parent.touch(), "File exists")])
def test_a_file_that_cannot_be_written_is_refused_before_any_question(home, name, make, reason):
    make(home / name)
    with pytest.raises(JetbotError) as error:
        calibrate["output_file"](home / name, False)
    assert str(error.value) == f"The file {home / name} cannot be written: {reason}. Name another with --output."


def test_a_simulated_robot_is_not_written_to_the_real_ones_file_by_another_name(home):
    (home / "link.yaml").symlink_to("jetbot.yaml")
    for name in ("jetbot.yaml", "link.yaml"):
        with pytest.raises(JetbotError, match="is for the real robot, and this one is simulated"):
            calibrate["output_file"](home / name, True)


def test_finds_a_board_at_another_address_and_calibrates_it_there(home, folder, monkeypatch):
    seen = []

    class Recorder(Wizard):
        def find_motors(self):
            seen.append(self.parameters)

    place = {"i2c_bus": f"fake:{folder}", "port": ""}
    lock_board(place["i2c_bus"], 0x61).close()  # a fake bus is made with a chip there
    monkeypatch.setattr("builtins.input", lambda question: "")
    monkeypatch.setitem(calibrate["calibrate"].__globals__, "Wizard", Recorder)
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
    questions = []
    monkeypatch.setattr("builtins.input", lambda question: questions.append(question) or answers.pop())
    assert calibrate["drivable"](checks) == driven
    assert not answers
    assert set(questions) <= {"Is it certain that the chip at 0x40 is Waveshare's Motor Driver HAT and no servo board? "
                              "[yes/no] "}


@pytest.mark.parametrize("board, frequency", [("jetbot", 50), ("waveshare_hat", 50), ("sparkfun", None)])
def test_a_pca9685_drives_at_a_frequency_at_which_motors_start_early(board, frequency):
    assert Wizard(board=board).parameters.get("pwm_frequency") == frequency


@pytest.mark.parametrize("guarded, ends_at", [([True, True], None), ([True, False], 1)])
def test_a_motion_ends_when_the_guard_is_lost(monkeypatch, guarded, ends_at):
    robot = MagicMock()
    robot.__enter__.return_value = robot
    type(robot).guarded = PropertyMock(side_effect=guarded)
    monkeypatch.setattr("jetbot_tools.wizard.Robot", lambda **_: robot)
    monkeypatch.setattr("jetbot_tools.wizard.single_keys", contextlib.nullcontext)
    monkeypatch.setattr("jetbot_tools.wizard.key_pressed", lambda timeout: False)
    monkeypatch.setattr("builtins.input", lambda question: "")
    motion = [Step(0.1, 0.1), Step(0.2, 0.2)]
    assert Wizard(board="jetbot").drive("", motion) == (None if ends_at is None else motion[ends_at])
