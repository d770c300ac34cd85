"""A robot that is simulated with the body and the parameters of its calibration drives as the calibrated one."""

import pytest
import yaml

from jetbot.fake.motors import Motors
from jetbot.kinematics import mix
from jetbot_tools.calibration.body import body_of
from jetbot_tools.calibration.settings import write_all
from simulation.diff_drive import Body, DiffDriveModel
from simulation.simulated_robot import SimulatedRobot
from simulation.simulation_parameters import resolve

WIRING = {"swap_motors": True, "invert_left": True, "invert_right": False}
CALIBRATED = {**WIRING, "left_motor_alpha": 1.0, "right_motor_alpha": 0.95, "max_speed": 0.5, "pwm_frequency": 50}
SEPARATION = 0.12


def simulated(folder, body):
    """A simulated robot on a fake bus, with a body for ``resolve``."""
    given = resolve(body)
    return SimulatedRobot(Motors(folder), DiffDriveModel(Body(*(given[name] for name in Body._fields))))


@pytest.mark.parametrize("velocity", [(0.25, 0.0), (0.1, 1.5), (-0.2, -0.5)])
def test_in_metres_and_radians_it_obeys(folder, make_robot, velocity):
    robot = make_robot(board="adafruit", **{name: CALIBRATED[name] for name in CALIBRATED if name != "max_speed"})
    model = simulated(folder, body_of({**CALIBRATED, "wheel_separation": SEPARATION}, 0.02))
    robot.set_motors(*mix(*velocity, SEPARATION, CALIBRATED["max_speed"]))
    model.step(200)
    assert model.model.velocity == pytest.approx(velocity, abs=0.002)


def test_without_a_tape_measure_it_drives_straight_and_starts_where_it_was_seen_to_start(folder, make_robot):
    known = {"left_motor_alpha": 0.9, "right_motor_alpha": 1.0, "min_duty": 0.02, "pwm_frequency": 50}
    model = simulated(folder, body_of(known, 0.02))
    robot = make_robot(board="adafruit", **known)
    robot.set_motors(0.4, 0.4)  # as the calibration does
    model.step(200)
    assert model.model.velocity == (pytest.approx(0.25, abs=0.05), pytest.approx(0.0, abs=0.01))
    robot.set_motors(0.01, 0.01)
    model.step(200)
    assert model.model.moving
    untrimmed = make_robot(board="adafruit", pwm_frequency=50)
    untrimmed.set_motors(0.018, 0.018)
    model.step(200)
    assert not model.model.moving


def test_of_a_board_that_controls_its_wheels_the_wiring_is_known():
    assert body_of({"board": "jetbot_pro", **WIRING}, 0.0) == WIRING


def test_the_calibration_writes_it_beside_the_parameters_and_names_the_command(tmp_path, capsys):
    write_all(tmp_path / "my.yaml", CALIBRATED, body_of(CALIBRATED, 0.02))
    assert yaml.safe_load((tmp_path / "my_body.yaml").read_text()) == body_of(CALIBRATED, 0.02)
    assert resolve({"body": str(tmp_path / "my_body.yaml")})["swap_motors"] is True
    assert f"simulation.launch config:={tmp_path}/my.yaml body:={tmp_path}/my_body.yaml" in capsys.readouterr().out
