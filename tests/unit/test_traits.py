"""A motor's ``value`` as a trait, which takes nothing from a stop; and what is not imported for it."""

import os
import subprocess
import sys
import threading

import pytest

from conftest import PACKAGES, PYTHONPATH
from jetbot import robot
from jetbot.fake.motors import wheel_speeds

HEAVY = {"traitlets", "numpy", "PIL", "ipywidgets"}


def run(code, folder):
    """Run Python code in a process of its own, on a fake bus; return what it prints."""
    return subprocess.run([sys.executable, "-c", code], check=True, stdout=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONPATH": PYTHONPATH, "JETBOT_I2C_BUS": f"fake:{folder}"}).stdout


@pytest.mark.parametrize("code", ["import jetbot", "import jetbot.camera.stream",
                                  "from jetbot.robot import Robot; Robot().forward(0.1)"])
def test_what_is_heavy_is_not_imported_for_nothing(folder, code):
    assert run(f"import sys; {code}; print({HEAVY} & set(sys.modules))", folder) == "set()\n"


def test_without_traitlets_it_drives(folder):
    code = ("import sys; sys.modules.update(traitlets=None, numpy=None, PIL=None); from jetbot import Motor, Robot\n"
            "robot = Robot(); robot.left_motor.value = 0.5; print(type(robot.left_motor) is Motor)\n"
            "from jetbot.fake.motors import wheel_speeds; print(wheel_speeds(robot.driver.link.name[len('fake:'):]))")
    assert run(code, folder) == "True\n(0.5, 0.0)\n"


def test_no_program_of_ours_takes_a_robot_with_traits():
    names = r"^\s*from jetbot import .*\b(Robot|Motor|Camera)\b"
    found = subprocess.run(["grep", "-rnE", "--include=*.py", names, str(PACKAGES)], stdout=subprocess.PIPE).stdout
    assert found == b""


@pytest.fixture
def traits_robot(make_robot, monkeypatch):
    """A robot as ``from jetbot import Robot`` makes it where traitlets is installed."""
    pytest.importorskip("traitlets")
    from jetbot import Robot
    monkeypatch.setattr(robot, "Robot", Robot)
    return make_robot()


@pytest.fixture
def slider():
    """A widget's slider, as far as links need one."""
    import traitlets

    class Slider(traitlets.HasTraits):
        value = traitlets.CFloat(0.0, min=-1.0, max=1.0)

    return Slider()


def test_a_slider_moves_the_wheel_and_the_wheel_the_slider(traits_robot, folder, slider):
    import traitlets
    link = traitlets.link((slider, "value"), (traits_robot.left_motor, "value"))
    slider.value = 0.5
    assert wheel_speeds(folder) == (0.5, 0)
    traits_robot.right(0.25)
    assert slider.value == 0.25
    link.unlink()
    slider.value = 1
    assert wheel_speeds(folder) == (0.25, -0.25)


def test_observers_see_each_wheel_after_both_are_driven(traits_robot, folder):
    seen = []
    for motor in (traits_robot.left_motor, traits_robot.right_motor):
        motor.observe(lambda change: seen.append((change["old"], change["new"], wheel_speeds(folder))), names="value")
    traits_robot.set_motors(0.5, -0.5)
    traits_robot.set_motors(0.5, -0.5)
    assert seen == [(0, 0.5, (0.5, -0.5)), (0, -0.5, (0.5, -0.5))]


def test_what_is_no_speed_stops_and_the_slider_shows_it(traits_robot, folder, slider):
    import traitlets
    traitlets.dlink((traits_robot.left_motor, "value"), (slider, "value"))
    traits_robot.forward(0.5)
    with pytest.raises(ValueError, match="^A speed must be a finite number"):
        traits_robot.left_motor.value = "fast"
    assert (wheel_speeds(folder), slider.value) == ((0, 0), 0)


def test_an_observer_that_hangs_delays_no_stop_of_another_thread(traits_robot, folder):
    entered, leave, seen = threading.Event(), threading.Event(), []

    def hang(change):
        entered.set()
        leave.wait()
        seen.append(change["new"])

    traits_robot.left_motor.observe(hang, names="value")
    driving, stopping = (threading.Thread(target=command, daemon=True) for command in (
        lambda: traits_robot.forward(0.5), traits_robot.stop))
    driving.start()
    assert entered.wait(10)
    stopping.start()
    stopping.join(10)
    late = stopping.is_alive()
    leave.set()
    driving.join(10)
    assert (late, wheel_speeds(folder), seen) == (False, (0, 0), [0.5, 0])
