"""What ./morbot installs on each system, with fake package tools."""

import os
import re
import shutil
import subprocess

import pytest

from conftest import ROOT

MORBOT = ROOT / "morbot"
TOOLS = {
    "dpkg-query": "exit 1",                                        # nothing is installed yet
    "id": "echo 0",
    "python3": "exit 1",                                           # no smbus2
    "apt-cache": 'case "$*" in *$UNKNOWN*) exit 100 ;; esac',
    "apt-get": 'echo apt-get "$@" >>"$LOG"',
    "pip3": 'echo pip3 "$@" >>"$LOG"',
}


@pytest.fixture
def install(tmp_path):
    """Return a function that runs ./morbot install on a system: (exit code, output, commands of the tools)."""
    for name, body in TOOLS.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{body}\n")
        (tmp_path / name).chmod(0o755)

    def run(system, version, unknown="nothing"):
        names = f'VERSION_ID="{version}"\nPRETTY_NAME="{system} {version}"\n' if version else ""
        (tmp_path / "os-release").write_text(f"ID={system}\n{names}")
        log = tmp_path / "log"
        log.touch()
        environment = {**os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "LOG": str(log), "UNKNOWN": unknown,
                       "OS_RELEASE": str(tmp_path / "os-release")}
        process = subprocess.run(["sh", str(MORBOT), "install"], env=environment, text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT)
        return process.returncode, process.stdout, log.read_text()

    return run


@pytest.mark.parametrize("system", [("debian", 12), ("debian", 13), ("ubuntu", "22.04"), ("ubuntu", "24.04")])
def test_systems_that_package_ros_themselves(install, system):
    code, _, commands = install(*system)
    assert code == 0
    assert " python3-rospy " in commands and " python3-smbus2 " in commands
    assert "noetic" not in commands and "pip3" not in commands


def test_noetic(install):
    code, _, commands = install("ubuntu", "20.04")
    assert code == 0
    assert commands.endswith("pip3 install -q smbus2\n")
    installed = set(re.findall(r"no-install-recommends (.*)", commands)[0].split())
    assert {"ros-noetic-rospy", "ros-noetic-catkin", "ros-noetic-ros-environment", "ros-noetic-geometry-msgs",
            "ros-noetic-rostest", "ros-noetic-tf2-ros", "ros-noetic-robot-state-publisher", "python3-serial",
            "python3-pip", "g++"} <= installed
    assert not {name for name in installed if re.match("python3-(ros|tf2|.*-msgs|smbus2)|lib|ros-(?!noetic)", name)}


@pytest.mark.parametrize("system, unknown, sentence", [
    (("ubuntu", "20.04"), "ros-noetic-", "morbot: cannot find ROS Noetic. First add its source: http://wiki."),
    (("ubuntu", "22.04"), "python3-rospy", "morbot: cannot find all of these packages. On Ubuntu, try: sudo "),
    (("arch", None), "nothing", "morbot: cannot set up this system. These Debian packages are needed: "),
    (("fedora", "41"), "nothing", "morbot: cannot set up fedora 41. These Debian packages are needed: ")])
def test_what_cannot_be_set_up_is_reported_and_nothing_is_installed(install, system, unknown, sentence):
    code, printed, commands = install(*system, unknown)
    assert code == 1
    assert sentence in printed
    assert "install" not in commands


@pytest.mark.parametrize("name", [
    "$(touch x)", "`touch x`", "a b", "it's", 'a"b', "a\\b", "a\nb", "end\n", "a;b", "a:b", "{a}", "[a]", "a]", "a*",
    "a?", "<a>", "a#", "\x1b[2J "], ids=ascii)
def test_a_folder_whose_name_a_shell_or_cmake_misreads_is_refused(tmp_path, name):
    (tmp_path / name).mkdir()
    morbot = shutil.copy(MORBOT, tmp_path / name)
    process = subprocess.run([morbot, "setup"], cwd=tmp_path, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert process.returncode == 1
    assert process.stdout.startswith(b"morbot: the path of this folder has a space, a quote or one of ")
    assert process.stdout.decode().rstrip("\n").isprintable()
    assert os.listdir(tmp_path) == [name] and os.listdir(tmp_path / name) == ["morbot"]
