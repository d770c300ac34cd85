"""The recipes for a board and a block in CONTRIBUTING.md, followed as they are written."""

import re
import shutil

import another_chip
import pytest
from javascript import needs_node, node

from conftest import ROOT
from jetbot import Robot, boards
from jetbot.boards import BOARDS
from jetbot.connection import stop_board
from jetbot.fake.bus import power_on
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import I2CDevice
from jetbot.supply import find_supply
from jetbot_control_node import parameters as controller
from jetbot_tools.calibration.wizard import wizard_for
from jetbot_tools.doctor.checkup import check_bus, verdict
from simulation import simulation_parameters as simulation

PAGE = (ROOT / "CONTRIBUTING.md").read_text()
RECIPE = PAGE.split("## A board")[1].split("\n## ")[0]


ROW, = re.findall(r"```python\n(.*?)```", RECIPE, re.S)
MY_BOARD = eval(f"{{{ROW}}}", dict(vars(boards)))["myboard"]
ROWS = {"as it is written": MY_BOARD, "with another chip": another_chip.ROWS["small"],
        "with jumpers, where the voltmeter is": MY_BOARD._replace(address=0x41, jumpers=range(0x40, 0x48))}
PCA9685_ROWS = [name for name, row in ROWS.items() if row.chip == "PCA9685"]
on_a_pca9685 = pytest.mark.parametrize("row", PCA9685_ROWS, indirect=True)


@pytest.fixture(params=ROWS)
def row(request, monkeypatch):
    monkeypatch.setitem(BOARDS, "myboard", ROWS[request.param])
    return ROWS[request.param]


@pytest.fixture
def place(row, folder):
    """A fake bus, on which the board of the recipe is plugged in."""
    power_on(folder)
    return f"fake:{folder}"


def test_the_new_board_drives_and_its_motors_are_simulated(row, place, folder):
    with Robot("myboard", place, guard=False) as robot:
        for speeds in ((-1, 1), (0, 0), (0.5, -0.25)):
            robot.set_motors(*speeds)
            assert wheel_speeds(folder, "myboard") == pytest.approx(speeds, abs=robot.driver.resolution)
        stop_board(row, place)  # as the guard does
        assert wheel_speeds(folder, "myboard") == (0, 0)


def test_the_new_board_takes_no_chip_from_a_fake_bus(place, folder):
    for board in BOARDS:
        with Robot(board, place, place, guard=False) as robot:
            robot.forward(0.5)
            assert wheel_speeds(folder, board) == pytest.approx((0.5, 0.5), abs=robot.driver.resolution)
    assert find_supply(I2CDevice(place, 0x60)).read().voltage == pytest.approx(12.1)


@on_a_pca9685
def test_the_doctor_finds_the_new_board(row, place, folder):
    for file in folder.glob("0x*"):
        if file.name != f"0x{row.address:02x}":
            file.unlink()
    for board in "", "myboard":
        assert "board:=myboard" in verdict(check_bus(place, board=board)).command
    assert not any(check.command for check in check_bus(place, board="sparkfun"))


@on_a_pca9685
def test_the_new_board_is_calibrated_and_has_parameters(row, place):
    assert wizard_for("myboard", i2c_bus=place).parameters["pwm_frequency"] == 50
    assert controller.checked({"board": "myboard"})["board"] == "myboard"
    assert simulation.resolve({"board": "myboard", "i2c_bus": place})["board"] == "myboard"


@needs_node
def test_a_block_is_a_row_with_which_it_is_opened_and_becomes_python(tmp_path):
    row, = re.findall(r"```js\n(.*?)```", PAGE.split("## A block")[1].split("\n## ")[0], re.S)
    www = "morbot_ws/src/jetbot_cockpit/www"
    for folder in "tests/js", www:
        shutil.copytree(ROOT / folder, tmp_path / folder)
    shutil.copy(ROOT / "package.json", tmp_path)
    robot = tmp_path / www / "program/robot.js"
    robot.write_text(robot.read_text().replace("export const DRIVE = [\n", f"export const DRIVE = [\n{row}"))
    done = node("--test", "tests/js/blocks.test.js", cwd=tmp_path)
    assert done.returncode == 0 and "\nok 1 - robot_curve can be opened again" in done.stdout, done.stdout
