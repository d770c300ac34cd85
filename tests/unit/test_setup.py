"""What ./morbot installs on each system, with fake package tools."""

import os
import re
import shutil
import subprocess

import pytest

from conftest import ROOT

pytestmark = pytest.mark.shell
MORBOT = ROOT / "morbot"
TOOLS = {
    "dpkg-query": "exit 1",                                        # nothing is installed yet
    "id": "echo 0",
    "python3": "exit 1",                                           # no smbus2
    "apt-cache": 'case "$*" in *$UNKNOWN*) exit 100 ;; esac',
    "apt-get": 'case "$*" in *--simulate*) exit ${CONFLICT:-0} ;; esac; echo apt-get "$@" >>"$LOG"',
    "pip3": 'echo pip3 "$@" >>"$LOG"',
}


def write_tools(folder, bodies):
    for name, body in bodies.items():
        (folder / name).write_text(f"#!/bin/sh\n{body}\n")
        (folder / name).chmod(0o755)


@pytest.fixture
def install(tmp_path):
    """Return a function that runs ./morbot install on a system: (exit code, output, commands of the tools)."""
    write_tools(tmp_path, TOOLS)

    def run(os_release, unknown="nothing", **environment):
        (tmp_path / "os-release").write_text(os_release.replace("; ", "\n"))
        log = tmp_path / "log"
        log.touch()
        process = subprocess.run(["sh", str(MORBOT), "install"], text=True, stdout=subprocess.PIPE,
                                 stderr=subprocess.STDOUT, env={
            **os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "LOG": str(log), "UNKNOWN": unknown,
            "OS_RELEASE": str(tmp_path / "os-release"), "OPT_ROS": str(tmp_path / "ros"), **environment})
        return process.returncode, process.stdout, log.read_text()

    return run


UBUNTU = "ID=ubuntu; ID_LIKE=debian; VERSION_ID={}; VERSION_CODENAME={}; UBUNTU_CODENAME={}"
DEBIAN_12 = "ID=debian; VERSION_ID=12; VERSION_CODENAME=bookworm"
UBUNTU_20, UBUNTU_22, UBUNTU_24, UBUNTU_25 = (UBUNTU.format(number, name, name) for number, name in (
    ("20.04", "focal"), ("22.04", "jammy"), ("24.04", "noble"), ("25.10", "questing")))  # JetPack 5 is 20.04, too
MINT = 'ID=linuxmint; ID_LIKE="ubuntu debian"; VERSION_CODENAME=una; UBUNTU_CODENAME={}'
EVERYTHING = ""  # matches every package
NO_ROS = "morbot: {} has no packages of ROS 1\n"


@pytest.mark.parametrize("os_release", [
    UBUNTU_22, UBUNTU_25, MINT.format("jammy"),
    "ID=debian; VERSION_CODENAME=forky",  # while it is testing
    "ID=raspbian; ID_LIKE=debian; VERSION_ID=13; VERSION_CODENAME=trixie",
    "ID=linuxmint; ID_LIKE=debian; VERSION_ID=6; VERSION_CODENAME=faye; DEBIAN_CODENAME=bookworm",
    "ID=kali; ID_LIKE=debian; VERSION_ID=2025.4; VERSION_CODENAME=kali-rolling"])
def test_systems_that_package_ros_themselves_and_their_derivatives(install, os_release):
    code, _, commands = install(os_release)
    assert code == 0
    assert " python3-rospy " in commands and " python3-smbus2 " in commands
    assert "noetic" not in commands and "pip3" not in commands


@pytest.mark.parametrize("os_release", [UBUNTU_20, MINT.format("focal")])
def test_noetic(install, os_release):
    code, _, commands = install(os_release)
    assert code == 0
    assert commands.endswith("pip3 install -q smbus2 segno\n")
    installed = set(re.findall(r"no-install-recommends (.*)", commands)[0].split())
    assert {"ros-noetic-rospy", "ros-noetic-catkin", "ros-noetic-ros-environment", "ros-noetic-geometry-msgs",
            "ros-noetic-rostest", "ros-noetic-tf2-ros", "ros-noetic-robot-state-publisher", "python3-serial",
            "python3-tornado", "python3-pip", "g++"} <= installed
    assert not [name for name in installed if re.match(
        "python3-(ros|tf2|.*-msgs|smbus2|segno)|lib|ros-noetic-(tornado|segno)|ros-(?!noetic)", name)]


def test_ros_o_where_it_is_installed_already(install, tmp_path):
    (tmp_path / "ros/one").mkdir(parents=True)
    (tmp_path / "ros/one/setup.sh").touch()
    code, _, commands = install(UBUNTU_24, unknown="python3-rospy")
    assert code == 0
    assert " ros-one-rospy " in commands and " python3-smbus2 " in commands and "pip3" not in commands


@pytest.mark.parametrize("os_release, unknown, sentence", [
    # Debian's packages were removed just before the release of Ubuntu 24.04: https://bugs.launchpad.net/bugs/2063103
    (f"{UBUNTU_24}; PRETTY_NAME=Noble", "python3-rospy", NO_ROS.format("Noble")),
    (f"{MINT.format('noble')}; PRETTY_NAME=Wilma", "python3-rospy", NO_ROS.format("Wilma")),
    (f"{UBUNTU_25}; PRETTY_NAME=Questing", EVERYTHING, NO_ROS.format("Questing")),
    ("ID=fedora; VERSION_CODENAME=''; PRETTY_NAME='This one'", "nothing", NO_ROS.format("This one")),
    ("ID=steamos; ID_LIKE=arch; VERSION_CODENAME=holo; PRETTY_NAME=Odd", "nothing", NO_ROS.format("Odd")),
    ("", "nothing", NO_ROS.format(os.uname().sysname)),
    # a damaged description of the system is read, and not run
    ("ID=fedora\r; PRETTY_NAME='Odd'\r", "nothing", NO_ROS.format("Odd")),
    ("ID=mine; PATH=/nowhere; exit 3; PRETTY_NAME='$(echo Odd)'", "nothing", NO_ROS.format("$(echo Odd)")),
    ("{{}; ID=\"mine; PRETTY_NAME=Odd", "nothing", NO_ROS.format("Odd")),
    # apt does not know what such a system has
    (UBUNTU_20, "ros-noetic-", "; first add the source of ROS Noetic: http://wiki.ros.org/noetic/Installation/Ubuntu\n"),
    (UBUNTU_22, "python3-rospy", "morbot: apt cannot find python3-rospy; try: sudo add-apt-repository universe\n"),
    (DEBIAN_12, "python3-rospy", "morbot: apt cannot find python3-rospy\n")])
def test_where_ros_cannot_be_had_one_sentence_says_so_and_nothing_is_installed(install, os_release, unknown, sentence):
    code, printed, commands = install(os_release, unknown)
    assert code == 1 and printed.endswith(sentence)
    assert "apt-get install" not in commands


def test_apt_is_updated_before_it_is_said_not_to_know_packages(install, tmp_path):
    write_tools(tmp_path, {"apt-cache": 'grep -q "apt-get update" "$LOG"'})
    assert install(DEBIAN_12)[0] == 0


def test_the_second_description_is_read_where_the_first_is_missing(install, tmp_path):
    (tmp_path / "vendors").write_text("ID=mine\nPRETTY_NAME=Odd")
    assert install("", OS_RELEASE=f"/nowhere {tmp_path}/vendors")[1] == NO_ROS.format("Odd")


APT_FAILS = '[ "$1" = update ] || [ "$2" = --simulate ]'
NO_SUDO = {"id": "echo 1000", "sudo": "exit 1"}


@pytest.mark.parametrize("tools, environment, sentence", [
    ({}, {"CONFLICT": "100"}, "morbot: apt cannot install ROS 1 beside what is installed here, such as ROS 2\n"),
    (NO_SUDO, {}, f"morbot: an administrator must run this once: sudo {MORBOT} install\n"),
    ({"apt-get": APT_FAILS}, {}, "morbot: apt-get could not install these packages (see above)\n")],
    ids=["ROS 2 is there", "no sudo", "apt fails"])
def test_an_installation_that_fails_ends_with_one_sentence(install, tmp_path, tools, environment, sentence):
    write_tools(tmp_path, tools)
    code, printed, commands = install(DEBIAN_12, **environment)
    assert code == 1 and printed.endswith(sentence) and "apt-get install -y" not in commands


LAPTOP = """here=$1
fail() { echo "$*"; exit 1; }
. "$here/setup/install.sh"
. "$here/setup/laptop.sh"
environment() { :; }
has_modules() { false; }
choose_python"""


def test_on_a_laptop_without_sudo_the_sentence_installs_no_ros(tmp_path):
    write_tools(tmp_path, {**TOOLS, **NO_SUDO})
    (tmp_path / "os-release").write_text(DEBIAN_12.replace("; ", "\n"))
    done = subprocess.run(["sh", "-euc", LAPTOP, "sh", str(ROOT)], stdout=subprocess.PIPE, text=True, check=False, env={
        **os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "OS_RELEASE": str(tmp_path / "os-release")})
    assert done.returncode == 1 and done.stdout == (
        "an administrator must run this once: sudo apt install python3-tornado python3-segno python3-zeroconf\n")


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
