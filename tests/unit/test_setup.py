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
    "apt-get": 'case "$*" in *--simulate*) exit ${CONFLICT:-0} ;; esac; echo apt-get "$@" >>"$LOG"',
    "pip3": 'echo pip3 "$@" >>"$LOG"',
}


@pytest.fixture
def install(tmp_path):
    """Return a function that runs ./morbot install on a system: (exit code, output, commands of the tools)."""
    for name, body in TOOLS.items():
        (tmp_path / name).write_text(f"#!/bin/sh\n{body}\n")
        (tmp_path / name).chmod(0o755)

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


DEBIAN_12 = "ID=debian; VERSION_ID=12; VERSION_CODENAME=bookworm"
UBUNTU_20 = "ID=ubuntu; ID_LIKE=debian; VERSION_ID=20.04; VERSION_CODENAME=focal; UBUNTU_CODENAME=focal"
UBUNTU_22 = "ID=ubuntu; ID_LIKE=debian; VERSION_ID=22.04; VERSION_CODENAME=jammy; UBUNTU_CODENAME=jammy"
UBUNTU_24 = "ID=ubuntu; ID_LIKE=debian; VERSION_ID=24.04; VERSION_CODENAME=noble; UBUNTU_CODENAME=noble"
EVERYTHING = ""  # matches every package


@pytest.mark.parametrize("os_release", [
    DEBIAN_12, UBUNTU_22,
    "ID=debian; VERSION_ID=13; VERSION_CODENAME=trixie",
    "ID=debian; VERSION_CODENAME=forky",  # while it is testing
    "ID=raspbian; ID_LIKE=debian; VERSION_ID=13; VERSION_CODENAME=trixie",
    'ID=linuxmint; ID_LIKE="ubuntu debian"; VERSION_ID=21.3; VERSION_CODENAME=virginia; UBUNTU_CODENAME=jammy',
    "ID=linuxmint; ID_LIKE=debian; VERSION_ID=6; VERSION_CODENAME=faye; DEBIAN_CODENAME=bookworm",
    'ID=elementary; ID_LIKE="ubuntu debian"; VERSION_ID=7; VERSION_CODENAME=horus; UBUNTU_CODENAME=jammy'])
def test_systems_that_package_ros_themselves_and_their_derivatives(install, os_release):
    code, _, commands = install(os_release)
    assert code == 0
    assert " python3-rospy " in commands and " python3-smbus2 " in commands
    assert "noetic" not in commands and "pip3" not in commands


@pytest.mark.parametrize("os_release", [
    UBUNTU_20,  # JetPack 5 too
    'ID=linuxmint; ID_LIKE=ubuntu; VERSION_ID=20.3; VERSION_CODENAME=una; UBUNTU_CODENAME=focal'])
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


def test_packages_that_exclude_ros_1_as_those_of_ros_2_do_are_left_as_they_are(install):
    code, printed, commands = install(UBUNTU_22, CONFLICT="100")
    assert code == 1
    assert printed == "morbot: apt cannot install ROS 1 beside what is installed here, such as ROS 2\n"
    assert "apt-get install -y" not in commands


@pytest.mark.parametrize("os_release", [
    "ID=kali; ID_LIKE=debian; VERSION_ID=2025.4; VERSION_CODENAME=kali-rolling",
    "ID=ubuntu; ID_LIKE=debian; VERSION_ID=25.10; VERSION_CODENAME=questing; UBUNTU_CODENAME=questing",
    "ID=ubuntu; ID_LIKE=debian; VERSION_ID=26.04; VERSION_CODENAME=resolute; UBUNTU_CODENAME=resolute"])
def test_another_release_is_set_up_if_apt_knows_the_packages(install, os_release):
    code, _, commands = install(os_release)
    assert code == 0 and " python3-rospy " in commands
    code, printed, _ = install(os_release, unknown=EVERYTHING)
    assert code == 1 and printed.endswith(" has no packages of ROS 1\n")


@pytest.mark.parametrize("os_release", [
    UBUNTU_24,  # Debian's packages were removed just before its release: https://bugs.launchpad.net/bugs/2063103
    'ID=linuxmint; ID_LIKE="ubuntu debian"; VERSION_ID=22; VERSION_CODENAME=wilma; UBUNTU_CODENAME=noble',
    'ID=pop; ID_LIKE="ubuntu debian"; VERSION_ID=24.04; VERSION_CODENAME=noble; UBUNTU_CODENAME=noble'])
def test_ubuntu_24_has_no_ros_1(install, os_release):
    code, printed, commands = install(os_release, unknown="python3-rospy")
    assert code == 1 and printed.endswith(" has no packages of ROS 1\n") and not commands


@pytest.mark.parametrize("os_release", [
    "ID=fedora; VERSION_ID=40; VERSION_CODENAME=''", "ID=arch", "ID=nixos; VERSION_CODENAME=warbler; VERSION_ID=25.05",
    "ID=steamos; ID_LIKE=arch; VERSION_CODENAME=holo", ""])
def test_a_system_without_ros_is_named_and_nothing_is_installed(install, os_release):
    code, printed, commands = install(f"{os_release}; PRETTY_NAME='This one'" if os_release else "")
    assert code == 1
    assert printed.endswith(f"morbot: {'This one' if os_release else os.uname().sysname} has no packages of ROS 1\n")
    assert not commands


@pytest.mark.parametrize("os_release, name", [
    ("ID=mine; PRETTY_NAME=My Own Linux", "My Own Linux"), ("ID=fedora\r; PRETTY_NAME='Odd'\r", "Odd"),
    ("ID=mine; PATH=/nowhere; exit 3; PRETTY_NAME='$(echo Odd)'", "$(echo Odd)"),
    ("{{}; ID=\"mine; PRETTY_NAME=Odd", "Odd")])
def test_a_damaged_description_of_the_system_is_read_and_not_run(install, os_release, name):
    code, printed, _ = install(os_release)
    assert (code, printed) == (1, f"morbot: {name} has no packages of ROS 1\n")


def test_the_second_description_is_read_where_the_first_is_missing(install, tmp_path):
    (tmp_path / "vendors").write_text("ID=mine\nPRETTY_NAME=Odd")
    assert install("", OS_RELEASE=f"/nowhere {tmp_path}/vendors")[1] == "morbot: Odd has no packages of ROS 1\n"


@pytest.mark.parametrize("os_release, unknown, sentence", [
    (UBUNTU_20, "ros-noetic-", "; first add the source of ROS Noetic: http://wiki.ros.org/noetic/Install"),
    (UBUNTU_22, "python3-rospy", "morbot: apt cannot find python3-rospy; try: sudo add-apt-repository universe\n"),
    (DEBIAN_12, "python3-rospy", "morbot: apt cannot find python3-rospy\n")])
def test_packages_that_apt_cannot_find_are_named_and_nothing_is_installed(install, os_release, unknown, sentence):
    code, printed, commands = install(os_release, unknown)
    assert code == 1
    assert sentence in printed
    assert "apt-get install" not in commands


def test_without_sudo_one_sentence_says_what_an_administrator_types(install, tmp_path):
    (tmp_path / "id").write_text("#!/bin/sh\necho 1000\n")
    (tmp_path / "sudo").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "sudo").chmod(0o755)
    code, printed, commands = install(DEBIAN_12)
    assert code == 1 and not commands
    assert printed.endswith(f"morbot: an administrator must run this once: sudo {MORBOT} install\n")


LAPTOP = """here=$1
fail() { echo "$*"; exit 1; }
. "$here/setup/install.sh"
. "$here/setup/laptop.sh"
environment() { :; }
has_modules() { false; }
choose_python"""


def test_on_a_laptop_without_sudo_the_sentence_installs_no_ros(install, tmp_path):
    (tmp_path / "id").write_text("#!/bin/sh\necho 1000\n")
    (tmp_path / "sudo").write_text("#!/bin/sh\nexit 1\n")
    (tmp_path / "sudo").chmod(0o755)
    (tmp_path / "os-release").write_text(DEBIAN_12.replace("; ", "\n"))
    done = subprocess.run(["sh", "-euc", LAPTOP, "sh", str(ROOT)], stdout=subprocess.PIPE, text=True, check=False, env={
        **os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "OS_RELEASE": str(tmp_path / "os-release")})
    assert done.returncode == 1 and done.stdout == (
        "an administrator must run this once: sudo apt install python3-tornado python3-segno python3-zeroconf\n")


def test_a_failed_installation_ends_with_one_sentence(install, tmp_path):
    (tmp_path / "apt-get").write_text('#!/bin/sh\n[ "$1" = update ] || [ "$2" = --simulate ]\n')
    code, printed, _ = install(DEBIAN_12)
    assert code == 1 and printed.endswith("morbot: apt-get could not install these packages (see above)\n")


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
