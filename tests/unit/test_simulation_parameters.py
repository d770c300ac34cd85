"""The simulated robot's parameters: which are refused, whose board counts, and one size of the robot in every file."""

import os
import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION, SOURCE
from jetbot import InvalidValue
from jetbot.fake.motors import ROBOTS
from jetbot_control_node.control import ramp
from jetbot_control_node.odometry import dead_reckoning
from jetbot_control_node.parameters import load
from jetbot_ros.parameters import check_values
from jetbot_tools.calibration import corrections
from simulation.parameters import PARAMETERS, fake_folder, resolve

BODY = SIMULATION / "config/jetbot.yaml"
SIZE = load(BODY)


@pytest.mark.parametrize("name, value, must", [
    ("i2c_bus", 1, "fake, or fake:FOLDER"),
    ("i2c_bus", "faked", "fake, or fake:FOLDER"),
    ("port", "/dev/ttyACM0", "fake, or fake:FOLDER"),
    ("board", "lego", f"one of {', '.join(ROBOTS)}"),
    ("dead_band", 1, "a number of at least 0 and below 1"),
    ("motor_lag", -1, "a number of seconds, 0 or more"),
    ("wheel_diameter", 0, "a number above 0"),
    ("wheel_ratio", 0, "a number above 0"),
])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue, match=f"The parameter {name} must be {must}, not "):
        resolve({name: value})


def test_defaults_are_good():
    defaults = {name: parameter.default for name, parameter in PARAMETERS.items()}
    assert check_values({}, PARAMETERS) == resolve({}) == defaults


@pytest.mark.parametrize("typed, file, board", [
    ("", "{}", "jetbot"), ("", "board: sparkfun", "sparkfun"), ("jetbot", "board: sparkfun", "jetbot"),
    ("", "i2c_bus: 1", "jetbot")])
def test_simulates_the_board_that_the_controller_drives(tmp_path, typed, file, board):
    (tmp_path / "robot.yaml").write_text(file)
    parameters = resolve({"board": typed, "config": str(tmp_path / "robot.yaml"), "x": ""})
    assert (parameters["board"], parameters["i2c_bus"], parameters["x"]) == (board, "fake", 0.0)


@pytest.mark.parametrize("typed, file, address", [
    ("", "{}", None), ("0x61", "{}", "0x61"), ("", "i2c_address: 0x61", 0x61), (0x62, "i2c_address: 0x61", 0x62)])
def test_simulates_the_board_at_the_address_that_the_controller_drives(tmp_path, typed, file, address):
    (tmp_path / "robot.yaml").write_text(file)
    assert resolve({"i2c_address": typed, "config": str(tmp_path / "robot.yaml")})["i2c_address"] == address


@pytest.mark.parametrize("typed, file, published", [
    ("", "{}", False), (True, "{}", True), ("", "publish_odom: true", True), (False, "publish_odom: true", False)])
def test_knows_whether_the_controller_publishes_odom(tmp_path, typed, file, published):
    (tmp_path / "robot.yaml").write_text(file)
    assert resolve({"publish_odom": typed, "config": str(tmp_path / "robot.yaml")})["publish_odom"] is published


@pytest.mark.parametrize("board, folder", [("jetbot", "bus"), ("sparkfun", "bus"), ("jetbot_pro", "port")])
def test_reads_the_bus_or_the_port_of_the_board(board, folder):
    parameters = resolve({"board": board, "i2c_bus": "fake:bus", "port": "fake:port"})
    assert fake_folder(parameters, "/") == os.path.abspath(folder)


def test_the_file_of_the_body_shows_each_default_with_its_unit_and_meaning():
    rows = {name: row for name, row in PARAMETERS.items() if name in SIZE}
    assert BODY.read_text().splitlines()[1:] == [
        f"{name}: {row.default}  # {row.unit + '; ' if row.unit else ''}{row.doc}" for name, row in rows.items()]
    assert len(SIZE) == 6


def test_the_controller_assumes_the_same_size():
    controller = load(SOURCE / "config/si_units.yaml")
    assert all(controller[name] == SIZE[name] for name in ("wheel_separation", "max_speed"))
    assert corrections.WHEEL_SEPARATION == ramp.WHEEL_SEPARATION == SIZE["wheel_separation"]
    assert dead_reckoning.WHEEL_RADIUS == SIZE["wheel_diameter"] / 2


def test_si_units_draw_a_fraction_of_the_current_of_a_sudden_start():
    controller = load(SOURCE / "config/si_units.yaml")
    assert controller["acceleration_limit"] * SIZE["motor_lag"] < 0.2 * controller["max_speed"]


def test_the_drawn_robot_has_the_same_size():
    robot = ET.parse(SIMULATION / "urdf/jetbot.urdf").getroot()
    for side, sign in (("left", 1), ("right", -1)):
        radius = robot.find(f"link[@name='{side}_wheel']/visual/geometry/cylinder").get("radius")
        place = robot.find(f"joint[@name='{side}_wheel_joint']/origin").get("xyz").split()
        assert float(radius) == SIZE["wheel_diameter"] / 2
        assert float(place[1]) == sign * SIZE["wheel_separation"] / 2


@pytest.mark.parametrize("file", sorted((SIMULATION / "launch").glob("*.launch")), ids=lambda file: file.stem)
def test_every_launch_argument_has_a_doc(file):
    assert all(arg.get("doc") for arg in ET.parse(file).getroot().findall("arg"))


def test_the_launch_file_passes_on_what_is_typed_and_fake_hardware():
    launch = ET.parse(SIMULATION / "launch/simulation.launch").getroot()
    params = {param.get("name"): param.get("value") for param in launch.findall(".//node/param")}
    defaults = {arg.get("name"): arg.get("default") for arg in launch.findall("arg") if arg.get("name") in params}
    assert defaults == {**dict.fromkeys(params, ""), "i2c_bus": "fake", "port": "fake",
                        "body": "$(find simulation)/config/jetbot.yaml"}
    assert params == {name: f"$(arg {name})" for name in (*(set(PARAMETERS) - set(SIZE)), "config", "body")}


def test_what_is_typed_wins_over_the_file_of_the_body(tmp_path):
    (tmp_path / "body.yaml").write_text("max_speed: 0.3\nx: 1.0\ny: 2.0")
    parameters = resolve({"body": str(tmp_path / "body.yaml"), "x": 3.0, "y": ""})
    assert [parameters[name] for name in ("max_speed", "x", "y", "dead_band")] == [0.3, 3.0, 2.0, 0.05]


def test_a_body_that_cannot_be_read_is_refused():
    with pytest.raises(InvalidValue, match="^The file /dev/zero cannot be used: not a regular file. Fix it, or name"):
        resolve({"body": "/dev/zero"})
