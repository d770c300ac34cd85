"""What catkin_make installs works without its source: the page, the robots that it drives, and a user's programs."""

import shutil
import subprocess
from pathlib import Path

import pytest

from jetbot.fake.motors import wheel_speeds
from jetbot.wait import wait_until
from jetbot_cockpit.web.page_files import read_files
from processes import end, free_port, start
from project_copy import ROOT, clean_environment, copy_built_project, finish
from web_client import WebSocket, request

SOURCE = ROOT / "morbot_ws/src"
START_TIMEOUT = 60.0  # s
FOR_USERS = {  # what they print
    "rosrun jetbot_tools doctor.py --i2c-bus fake": "robot: could drive",
    "rosrun jetbot_tools calibrate.py --help": "usage: ",
    "rosrun jetbot_tools emergency_stop.py --help": "Stops every robot",
    "rosrun jetbot_cockpit forget_class.py --help": "usage: ",
    "rosrun driving_tasks judge.py": "park ",
    "rosrun jetbot_lessons check_lesson.py 1": "is installed, without its source: ",
    "roslaunch --nodes jetbot_class class.launch": "/class_judge"}
SERVED = "The cockpit, for a browser on this computer"
DRIVE = {"type": "drive", "robot": "/", "forward": 1, "left": 0}


@pytest.fixture(scope="module")
def installed(tmp_path_factory):
    """The environment of a shell that knows the install space of a built copy, which is deleted."""
    home = tmp_path_factory.mktemp("home")
    place, environment = home / "installed", clean_environment(home)
    workspace = copy_built_project(home) / "morbot_ws"
    (workspace / "src/jetbot_tests").resolve().mkdir(parents=True)  # is built, too
    shutil.copy(ROOT / "tests/ros/package.xml", workspace / "src/jetbot_tests")
    code, messages = finish(["cmake", "-P", workspace / "build/cmake_install.cmake"], environment)
    assert code == 0, messages
    (workspace / "install").rename(place)
    shutil.rmtree(workspace.parent)
    shell = subprocess.check_output(["bash", "-c", f"cd {home}; . {place}/setup.bash; env -0"], text=True, env={
        **environment, "ROS_MASTER_URI": f"http://localhost:{free_port()}", "ROS_HOSTNAME": "localhost"})
    return dict(variable.split("=", 1) for variable in shell.rstrip("\0").split("\0"))


@pytest.mark.parametrize("command", FOR_USERS)
def test_a_command_works(installed, command):
    code, messages = finish(command.split(), installed)
    assert FOR_USERS[command] in messages and "Traceback" not in messages


def test_each_program_is_installed(installed):
    programs = Path(installed["CMAKE_PREFIX_PATH"].partition(":")[0], "lib")
    scripts = [*SOURCE.glob("*/scripts/*.py")]
    assert [file for file in scripts if not (programs / file.parts[-3] / file.name).exists()] == [] != scripts


@pytest.fixture(scope="module")
def simulation(installed, tmp_path_factory):
    """A simulated robot with its page: (the page's port, the folder of the robot's bus)."""
    folder, port = tmp_path_factory.mktemp("simulation"), free_port()
    launch = start(["roslaunch", "simulation", "simulation.launch", "cockpit:=true", f"cockpit_port:={port}",
                    "rviz:=false", "world:=line.yaml", f"i2c_bus:=fake:{folder / 'bus'}"],
                   folder / "log", env=installed)
    try:
        wait_until(lambda: SERVED in launch.log.read_text() or launch.poll() is not None, START_TIMEOUT)
        assert SERVED in launch.log.read_text(), launch.log.read_text()
        yield port, folder / "bus"
    finally:
        end([launch])


def headers(port):
    return {"Host": f"localhost:{port}", "Origin": f"http://localhost:{port}"}


def test_each_file_of_the_page_is_served(simulation):
    port, _ = simulation
    files = read_files(SOURCE / "jetbot_cockpit/www")
    served = {name: request(port, "GET", f"/{name}", headers(port)).body for name in files}
    assert [name for name, file in files.items() if served[name] != file.plain] == [] != files


def test_the_page_drives_the_robot(simulation):
    port, bus = simulation
    page = WebSocket(port, headers(port))
    try:
        assert page.receive("hello")["role"] == "teacher"
        page.receive_until(lambda message: "/" in message.get("robots", {}))

        def drives():
            page.send(DRIVE)
            return min(wheel_speeds(bus)) > 0

        assert wait_until(drives, START_TIMEOUT, interval=0.1)
    finally:
        page.close()
