"""A launch argument that no launch file takes is refused with what was meant; what cannot be known is not refused."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from conftest import COCKPIT, PYTHONPATH, SOURCE
from jetbot_ros import launch_arguments
from jetbot_ros.launch_arguments import argument_problem
from jetbot_ros.roslaunch_command import parse

PACKAGES = SOURCE.parent
FOLDERS = {"jetbot_control_node": SOURCE, "simulation": PACKAGES / "simulation",
           "workshop": PACKAGES / "scenarios/workshop", "jetbot_cockpit": PACKAGES / "jetbot_cockpit",
           "jetbot_cockpit_server": COCKPIT}
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" {}/>'
PASS_ALL = INCLUDE.format('pass_all_args="true"')


@pytest.fixture(autouse=True)
def packages(monkeypatch):
    monkeypatch.setattr(launch_arguments, "package_folder", lambda name: str(FOLDERS.get(name, "")))


@pytest.fixture
def launch(tmp_path):
    """Return a function that writes a launch file with this content, and returns its name."""
    def write(content, name="pupil.launch"):
        (tmp_path / name).write_text(f"<launch>{content}</launch>")
        return str(tmp_path / name)
    return write


def refusal(*words):
    """Return what is refused on this command line of roslaunch."""
    command = parse(list(words))
    return argument_problem(command.files, command.typed)


@pytest.mark.parametrize("line, meant", [
    ("simulation simulation.launch motion:=true lineer:=0.2", "lineer. Did you mean linear:=0.2?"),
    ("simulation simulation.launch Rviz:=false", "Rviz. Did you mean rviz:=false?"),
    ("simulation three_robots.launch rvizz:=false", "rvizz. Did you mean rviz:=false?"),
    ("jetbot_control_node jetbot_controller.launch _i2c_bus:=fake", "_i2c_bus. Did you mean i2c_bus:=fake?"),
    ("jetbot_control_node jetbot_controller.launch foo:=3", "foo. The arguments are acceleration_limit, board, "),
    ("-p 11411 --screen workshop workshop_jetbot_controller.launch bord:=", "bord. Did you mean board:=?"),
    ("simulation simulation.launch cokpit:=true", "cokpit. Did you mean cockpit:=true?"),
    ("jetbot_cockpit cockpit.launch lann:=true", "lann. Did you mean lan:=true?"),
    ("jetbot_cockpit class.launch bord:=sparkfun", "bord. Did you mean board:=sparkfun?"),
    (f"{SOURCE}/launch/many_robots.launch {SOURCE}/launch/jetbot_controller.launch robts:=3",
     "robts. Did you mean robots:=3?")])
def test_a_mistyped_argument_is_refused_with_what_was_meant(line, meant):
    assert refusal(*line.split()).startswith(f"morbot: there is no argument {meant}")


@pytest.mark.parametrize("line", [
    "simulation simulation.launch motion:=true linear:=0.2 board:=sparkfun required:=true __ns:=red _other:=1",
    "jetbot_control_node many_robots.launch robots:=3 max_speed:=0.5",
    "jetbot_cockpit class.launch robots:=15 lan:=true config:=si_units.yaml port:=8081",
    "simulation no_such.launch lineer:=1", "no_such_package x.launch lineer:=1", "- lineer:=1", "lineer:=1"])
def test_what_is_known_or_cannot_be_known_is_not_refused(line):
    assert refusal(*line.split()) is None


@pytest.mark.parametrize("content", [
    PASS_ALL, f'<arg name="speed" default="0.3"/><group ns="red">{PASS_ALL}</group>',
    '<include if="$(arg late)" file="$(dirname)/other.launch" pass_all_args="true"/>'])
def test_a_launch_file_of_a_pupil(launch, content):
    launch(PASS_ALL, "other.launch")
    assert refusal(launch(content), "i2c_bus:=fake") is None
    assert "Did you mean i2c_bus:=fake?" in refusal(launch(content), "i2c_bas:=fake")


@pytest.mark.parametrize("include", [
    INCLUDE.format(""), INCLUDE.format("").replace("/>", '><arg name="i2c_bus" value="$(arg bus)"/></include>')])
def test_an_argument_that_an_include_does_not_get_is_refused(launch, include):
    file = launch(include)
    assert refusal(file, "i2c_bus:=fake") == (
        'morbot: pupil.launch does not pass the argument i2c_bus on. Add pass_all_args="true" to its <include>.')


@pytest.mark.parametrize("content", [
    '<include file="$(arg file)" pass_all_args="true"/>', '<include file="$(eval file)" pass_all_args="true"/>',
    '<include file="$(find nowhere)/x.launch" pass_all_args="true"/>', '<include pass_all_args="true"/>',
    '<include file="/no/such/file" pass_all_args="true"/>', '<include file="$(env NOT_SET)" pass_all_args="true"/>',
    '<include file="$(" pass_all_args="true"/>', "<arg/>", "<arg", "\0",
    '<include file="/dev/zero" pass_all_args="1"/>',
    '<param name="speed" value="$(arg lineer)"/>', '<param name="speed" value="$(eval lineer * 2)"/>'],
    ids=lambda content: ascii(content)[:40])
def test_where_names_are_hidden_or_a_file_is_broken_nothing_is_refused(launch, content):
    assert refusal(launch(f'<arg name="linear"/>{content}'), "lineer:=1") is None


def test_launch_files_that_include_each_other(launch):
    file = launch('<include file="$(dirname)/pupil.launch" pass_all_args="true"/><arg name="linear"/>')
    assert "linear:=1" in refusal(file, "lineer:=1")
    file = launch('<include file="$(dirname)/./$(dirname)/../pupil.launch" pass_all_args="true"/>')
    assert refusal(file, "lineer:=1") is None


def test_reading_launch_files_is_given_up_in_time(monkeypatch):
    on_ctrl_c = signal.getsignal(signal.SIGINT)
    from jetbot_ros import prelaunch
    signal.signal(signal.SIGINT, on_ctrl_c)
    monkeypatch.setattr(prelaunch, "READING_TIMEOUT", 0.1)
    monkeypatch.setattr(launch_arguments, "package_folder", lambda name: time.sleep(60))
    start = time.monotonic()
    assert prelaunch.argument_problem_in_time(["simulation", "simulation.launch"], [("lineer", "1")]) is None
    assert time.monotonic() - start < 30


ROSLAUNCH = ("import subprocess, sys; sys.exit(subprocess.call([sys.executable, '-m', 'jetbot_ros.prelaunch'], "
             "timeout=30))")


@pytest.fixture
def roslaunch(tmp_path):
    """Return a function that runs a program named roslaunch, which runs the check: (exit code, output)."""
    program = tmp_path / "roslaunch"
    program.write_text(ROSLAUNCH)

    def run(*words):
        process = subprocess.run([sys.executable, program, *words], text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, timeout=60, cwd=tmp_path, env={
                                     **os.environ, "PYTHONPATH": PYTHONPATH,
                                     "ROS_MASTER_URI": "http://localhost:1"})
        return process.returncode, process.stdout

    return run


def test_roslaunch_is_ended_with_one_sentence(roslaunch, launch):
    file = launch('<arg name="linear"/>')
    assert roslaunch(file, "lineer:=\x1b[2J") == (
        -signal.SIGTERM, "morbot: there is no argument lineer. Did you mean linear:=\\x1b[2J?\n")
    assert roslaunch(file, "linear:=1") == (0, "")
    assert roslaunch("--nodes", file, "lineer:=1") == (0, "")


def test_a_launch_file_that_cannot_be_read_does_not_hold_up_roslaunch(roslaunch, tmp_path):
    os.mkfifo(Path(tmp_path, "pipe.launch"))
    assert roslaunch(tmp_path / "pipe.launch", "lineer:=1") == (0, "")
