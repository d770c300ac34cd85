"""The simulated robot's parameters: which are refused, whose board counts, and one size of the robot in every file."""

import os
import xml.etree.ElementTree as ET

import pytest

from conftest import SIMULATION, SOURCE
from jetbot import InvalidValue
from jetbot.boards import BOARDS
from jetbot_control_node.parameters import load
from simulation.diff_drive import JETBOT
from simulation.simulation_parameters import PARAMETERS, fake_folder, resolve

BODY = SIMULATION / "config/jetbot.yaml"


@pytest.mark.parametrize("name, value, must", [
    ("i2c_bus", 1, "fake, or fake:FOLDER"), ("port", "/dev/ttyACM0", "fake, or fake:FOLDER"),
    ("board", "lego", f"one of {', '.join(BOARDS)}"), ("wheel_ratio", 0, "a number above 0")])
def test_bad_values(name, value, must):
    with pytest.raises(InvalidValue, match=f"The parameter {name} must be {must}, not "):
        resolve({name: value})


@pytest.mark.parametrize("name, default, in_file, typed", [
    ("board", "jetbot", "sparkfun", "adafruit"), ("i2c_address", None, 0x61, "0x62"),
    ("publish_odom", False, True, False)])
def test_simulates_what_the_controller_drives(tmp_path, name, default, in_file, typed):
    (tmp_path / "robot.yaml").write_text(f"{name}: {in_file}\ni2c_bus: 1")
    config = {"config": str(tmp_path / "robot.yaml")}
    values = [resolve(given) for given in ({name: ""}, {name: "", **config}, {name: typed, **config})]
    assert [each[name] for each in values] == [default, in_file, typed]
    assert {each["i2c_bus"] for each in values} == {"fake"}


@pytest.mark.parametrize("board, folder", [("jetbot", "bus"), ("sparkfun", "bus"), ("jetbot_pro", "port")])
def test_reads_the_bus_or_the_port_of_the_board(board, folder):
    parameters = resolve({"board": board, "i2c_bus": "fake:bus", "port": "fake:port"})
    assert fake_folder(parameters, "/") == os.path.abspath(folder)


def test_what_is_typed_wins_over_the_file_of_the_body(tmp_path):
    (tmp_path / "body.yaml").write_text("max_speed: 0.3\nx: 1.0\ny: 2.0")
    parameters = resolve({"body": str(tmp_path / "body.yaml"), "x": 3.0, "y": ""})
    assert [parameters[name] for name in ("max_speed", "x", "y", "dead_band")] == [0.3, 3.0, 2.0, 0.05]


def test_the_file_of_the_body_shows_each_default_with_its_unit_and_meaning():
    assert BODY.read_text().splitlines()[1:] == [
        f"{name}: {row.default}  # {row.unit + '; ' if row.unit else ''}{row.doc}"
        for name, row in PARAMETERS.items() if name in JETBOT._fields]


def test_si_units_are_those_of_this_body_and_draw_a_fraction_of_the_current_of_a_sudden_start():
    controller = load(SOURCE / "config/si_units.yaml")
    assert (controller["wheel_separation"], controller["max_speed"]) == (JETBOT.wheel_separation, JETBOT.max_speed)
    assert controller["acceleration_limit"] * JETBOT.motor_lag < 0.2 * controller["max_speed"]


def test_the_drawn_robot_has_the_same_size():
    robot = ET.parse(SIMULATION / "urdf/jetbot.urdf").getroot()
    for side, sign in (("left", 1), ("right", -1)):
        radius = robot.find(f"link[@name='{side}_wheel']/visual/geometry/cylinder").get("radius")
        place = robot.find(f"joint[@name='{side}_wheel_joint']/origin").get("xyz").split()
        assert float(radius) == JETBOT.wheel_diameter / 2
        assert float(place[1]) == sign * JETBOT.wheel_separation / 2


def test_the_launch_file_passes_on_what_is_typed_and_fake_hardware():
    launch = ET.parse(SIMULATION / "launch/simulation.launch").getroot()
    assert all(arg.get("doc") for arg in launch.findall("arg"))
    params = {param.get("name"): param.get("value") for param in launch.findall("group/group/param")}
    defaults = {arg.get("name"): arg.get("default") for arg in launch.findall("arg") if arg.get("name") in params}
    assert defaults == {**dict.fromkeys(params, ""), "i2c_bus": "fake", "port": "fake",
                        "body": "$(find simulation)/config/jetbot.yaml"}
    own = set(PARAMETERS) - set(JETBOT._fields) | {"variation", "config", "body"}
    assert params == {name: f"$(arg {name})" for name in own}
