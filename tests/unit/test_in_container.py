"""Where a system has no packages of ROS 1, ./morbot runs in a container; with fake container engines."""

import os
import signal
import socket
import subprocess
import sys

import pytest

from conftest import ROOT

MORBOT, ATTEND = ROOT / "morbot", ROOT / "docker/attend"
WITHOUT_ROS = ["sh", "-c", MORBOT.read_text().replace("is_installed ||", "reason=nothing;"), MORBOT]
FEDORA = 'ID=fedora\nVERSION_ID=40\nPRETTY_NAME="Fedora Linux 40"\n'
JETPACK_4 = 'ID=ubuntu\nID_LIKE=debian\nVERSION_CODENAME=bionic\nPRETTY_NAME="Ubuntu 18.04.6 LTS"\n'
UBUNTU_24 = 'ID=ubuntu\nID_LIKE=debian\nUBUNTU_CODENAME=noble\nPRETTY_NAME="Ubuntu 24.04.1 LTS"\n'
UBUNTU_26 = 'ID=ubuntu\nID_LIKE=debian\nUBUNTU_CODENAME=resolute\nPRETTY_NAME="Ubuntu 26.04 LTS"\n'
NO_ROS = "morbot: Fedora Linux 40 has no packages of ROS 1; "
ENGINE = """echo "${0##*/} $*" >>"$LOG"
case "$1 $2 $4" in
    --version*) %(version)s ;;
    "ps --filter"*) cat "$LOG.running" 2>/dev/null || : ;;
    ps*) %(ps)s ;;
    version*) echo %(server)s ;;
    info*) echo "[name=seccomp,profile=default] $RUNTIMES" ;;
    "image inspect "*) [ -e "$LOG.built" ] ;;
    build*) %(build)s && touch "$LOG.built" ;;
    run*) case $* in *"${CANNOT:-nothing}"*) exit 125 ;; esac; echo "$5" >>"$LOG.running" ;;
    "exec "*) [ "$3" != touch ] || grep -qxs "$2" "$LOG.running" ;;
esac
"""
MISSING = {"version": "exit 127", "ps": ":", "server": "", "build": ":"}
INSTALL_PODMAN = """sed -i 's/exit 127/echo podman version 4.9.3/' "${0%apt-get}podman\""""
WORKING = {"version": "echo 'Docker version 24.0.5'", "ps": ":", "server": "24.0.5", "build": ":"}
PODMAN = {**WORKING, "version": "echo podman version 4.3.1"}


@pytest.fixture
def morbot(tmp_path):
    """Return a function that runs ./morbot on a system: (exit code, what it prints, the engines' command lines)."""
    home = tmp_path / "home"
    home.mkdir()

    def run(*arguments, system=FEDORA, docker=MISSING, podman=MISSING, uid=1234, **environment):
        for name, body in {"docker": ENGINE % docker, "podman": ENGINE % podman, "apt-get": INSTALL_PODMAN,
                           "apt-cache": '[ "$*" = "show podman" ]', "dpkg-query": "exit 1",
                           "id": f"[ $1 = -un ] && echo pupil || echo {uid}"}.items():
            (tmp_path / name).write_text(f"#!/bin/sh\n{body}\n")
            (tmp_path / name).chmod(0o755)
        (tmp_path / "os-release").write_text(system)
        log = tmp_path / "log"
        log.write_text("")
        process = subprocess.run([*WITHOUT_ROS, *arguments], text=True, cwd=ROOT / "docs", stdin=subprocess.DEVNULL,
                                 stdout=subprocess.PIPE, stderr=subprocess.STDOUT, env={
            **os.environ, "PATH": f"{tmp_path}:{os.environ['PATH']}", "HOME": str(home), "LOG": str(log),
            "OS_RELEASE": str(tmp_path / "os-release"), "HOST_ROOT": str(tmp_path / "host"), **environment})
        return process.returncode, process.stdout, log.read_text().splitlines()

    return run


def words_of(commands, beginning):
    """Return the command line that begins so, framed by spaces."""
    return f" {next(line for line in commands if line.startswith(beginning))} "


def test_the_first_command_builds_the_image_and_starts_the_container_that_later_ones_share(morbot):
    code, printed, commands = morbot("run", "linear:=0.2", docker=WORKING)
    assert code == 0
    assert printed.startswith("morbot: Fedora Linux 40 has no packages of ROS 1; running in a container of docker\n")
    assert " --target system " in words_of(commands, "docker build")
    assert commands[-1].startswith(f"docker exec -i --workdir {ROOT}/docs")
    assert commands[-1].endswith(f" {MORBOT} run linear:=0.2")
    _, _, later = morbot("shell", docker=WORKING)
    assert not [line for line in later if line.split()[1] in ("build", "run")]
    container = words_of(commands, "docker run").partition("--name ")[2].split()[0]
    assert f" {container} {ATTEND} " in later[-1]


@pytest.mark.parametrize("system, name", [(UBUNTU_24, "Ubuntu 24.04.1 LTS"), (UBUNTU_26, "Ubuntu 26.04 LTS")])
def test_podman_is_installed_where_apt_has_it_and_no_engine_is_there(morbot, system, name):
    code, printed, commands = morbot("run", system=system, uid=0)
    assert code == 0
    assert f"morbot: {name} has no packages of ROS 1; installing podman, to run in a container\n" in printed
    assert commands[-1].startswith("podman exec ")


def test_the_container_has_this_folder_the_users_settings_network_and_processes(morbot, tmp_path):
    started = words_of(morbot("shell", docker=WORKING)[2], "docker run")
    for option in (f"--volume {ROOT}:{ROOT}", f"--volume {tmp_path}/home/.ros:{tmp_path}/home/.ros", "--network host",
                   "--pid host", "--user 1234:1234", f"--env HOME={tmp_path}/home"):
        assert f" {option} " in started


@pytest.fixture
def plug_in(tmp_path):
    """Return a function that gives this computer a device, which everybody may open."""
    (tmp_path / "host/dev").mkdir(parents=True)

    def plug(name):
        device = tmp_path / "host/dev" / name
        device.symlink_to("/dev/null")
        return device

    return plug


@pytest.fixture
def jetson(tmp_path):
    """Make this computer one whose daemon for the camera runs; return the daemon's socket."""
    path = tmp_path / "host/tmp/argus_socket"
    path.parent.mkdir(parents=True)
    with socket.socket(socket.AF_UNIX) as daemon:
        daemon.bind(os.path.relpath(path))  # a socket's path may have 107 characters
        yield path


def test_the_container_has_motor_boards_and_cameras_with_the_groups_that_may_open_them(morbot, plug_in):
    devices = [plug_in(name) for name in ("i2c-1", "ttyACM0", "ttyUSB1", "video0", "video10")]
    started = words_of(morbot("shell", docker=WORKING)[2], "docker run")
    for device in devices:
        assert f" --device {device} --group-add {os.stat(device).st_gid} " in started


def test_a_camera_that_was_plugged_in_is_in_a_further_container(morbot, plug_in):
    first = words_of(morbot("shell", docker=WORKING)[2], "docker run")
    camera = plug_in("video0")
    later = words_of(morbot("shell", docker=WORKING)[2], "docker run")
    assert f" --device {camera} " not in first and f" --device {camera} " in later


def test_a_stop_waits_for_no_other_container_when_a_device_was_plugged_in(morbot, plug_in):
    container = words_of(morbot("shell", docker=WORKING)[2], "docker run").partition("--name ")[2].split()[0]
    plug_in("video0")
    commands = morbot("stop", docker=WORKING)[2]
    assert f" {container} {ATTEND} " in commands[-1]
    assert not [line for line in commands if line.startswith("docker run")]


def test_a_jetsons_camera_is_reached_by_its_daemon_and_nvidias_libraries(morbot, jetson):
    started = words_of(morbot("shell", docker=WORKING, RUNTIMES="nvidia:{} runc:{}")[2], "docker run")
    assert " --runtime nvidia --env NVIDIA_VISIBLE_DEVICES=all --env NVIDIA_DRIVER_CAPABILITIES=all " in started
    assert f" --volume {jetson}:{jetson} " in started


@pytest.mark.parametrize("folder", ["etc/cdi", "run/cdi"])
def test_a_jetsons_camera_in_podman(morbot, jetson, tmp_path, folder):
    specification = tmp_path / "host" / folder / "nvidia.yaml"
    specification.parent.mkdir(parents=True)
    specification.write_text("kind: nvidia.com/gpu\n")
    started = words_of(morbot("shell", podman=PODMAN)[2], "podman run")
    assert f" --device nvidia.com/gpu=all --volume {jetson}:{jetson} " in started


def test_without_nvidias_toolkit_a_jetson_drives_without_its_camera(morbot, jetson):
    code, _, commands = morbot("shell", docker=WORKING, RUNTIMES="runc:{}")
    assert code == 0 and "argus" not in words_of(commands, "docker run")


def test_a_jetson_drives_without_its_camera_where_the_libraries_do_not_start(morbot, jetson):
    code, printed, commands = morbot("shell", docker=WORKING, RUNTIMES="nvidia:{} runc:{}", CANNOT="--runtime nvidia")
    assert code == 0
    assert "morbot: docker cannot give the Jetson's camera to the container (see above); trying without it\n" in printed
    assert commands[-1].startswith("docker exec ")
    assert not [line for line in commands if "cannot start the container" in line]


def test_a_daemon_of_the_camera_that_was_restarted_is_in_a_further_container(morbot, jetson):
    morbot("shell", docker=WORKING, RUNTIMES="nvidia:{}")
    os.rename(jetson, jetson.with_name("old"))  # keeps its inode
    with socket.socket(socket.AF_UNIX) as daemon:
        daemon.bind(os.path.relpath(jetson))
        assert words_of(morbot("shell", docker=WORKING, RUNTIMES="nvidia:{}")[2], "docker run")


def test_a_podman_without_root_keeps_the_users_id(morbot):
    started = words_of(morbot("shell", podman=PODMAN)[2], "podman run")
    assert " --user 1234:1234 --userns keep-id --group-add keep-groups " in started


def test_a_docker_that_is_podman_is_podman(morbot):
    assert morbot("shell", docker=PODMAN, podman=PODMAN)[2][-1].startswith("podman exec ")


@pytest.mark.parametrize("system, server, base", [
    (FEDORA, "24.0.5", "docker.io/library/debian:bookworm-slim"),
    (FEDORA, "20.10.5", "docker.io/library/ros:noetic-ros-base-focal"),
    (JETPACK_4, "24.0.5", "docker.io/library/ros:noetic-ros-base-focal")])
def test_the_image_is_one_that_the_docker_can_run(morbot, system, server, base):
    commands = morbot("shell", system=system, docker={**WORKING, "server": server})[2]
    assert f" BASE={base} " in words_of(commands, "docker build")


@pytest.mark.parametrize("engines, advice", [
    ({}, "with docker or podman, it runs in a container: https://podman.io/docs/installation\n"),
    ({"docker": {**WORKING, "ps": "echo 'permission denied while trying to connect' >&2; exit 1"}},
     "docker is there, but closed to you: sudo usermod -aG docker pupil, and log in again\n"),
    ({"docker": {**WORKING, "ps": "echo 'Is the docker daemon running?' >&2; exit 1"}},
     "docker is there, but not running: sudo systemctl enable --now docker\n"),
    ({"podman": {**PODMAN, "ps": "exit 125"}},
     "podman is there, but does not work; see: podman ps\n")])
def test_without_a_container_engine_one_sentence_says_what_to_type(morbot, engines, advice):
    code, printed, commands = morbot("run", **engines)
    assert code == 1
    assert printed == NO_ROS + advice
    assert not [line for line in commands if line.split()[1] in ("build", "run", "exec")]


def test_a_failed_build_of_the_image_ends_with_one_sentence(morbot):
    code, printed, commands = morbot("run", docker={**WORKING, "build": "echo no network; false"})
    assert code == 1
    assert "no network\nmorbot: cannot build the image (see above); the first use needs the internet\n" in printed
    assert not [line for line in commands if line.startswith("docker run")]


@pytest.fixture
def attend():
    """Return a function that attends a command for a client, which sleeps: (the client, the attendant)."""
    processes = []

    def run(*command):
        client = subprocess.Popen(["sleep", "60"], preexec_fn=os.setpgrp)
        attendant = subprocess.Popen([sys.executable, ATTEND, str(client.pid), *command], start_new_session=True,
                                     stdout=subprocess.PIPE, text=True)
        processes.append((client, attendant))
        return client, attendant

    yield run
    for client, attendant in processes:
        client.kill()
        client.wait()
        attendant.wait(10)


def test_an_attended_command_passes_on_its_exit_code(attend):
    assert attend("sh", "-c", "exit 3")[1].wait(10) == 3


@pytest.mark.parametrize("end", [signal.SIGKILL, signal.SIGHUP, signal.SIGSTOP])
def test_a_command_hangs_up_when_its_client_ends_or_is_suspended(attend, end):
    client, attendant = attend("sh", "-c", "trap 'echo hung up; exit' HUP; echo ready; sleep 60 >/dev/null & wait")
    assert attendant.stdout.readline() == "ready\n"
    client.send_signal(end)
    assert attendant.stdout.readline() == "hung up\n"


def test_a_command_hangs_up_when_it_is_suspended(attend):
    assert attend("sh", "-c", "kill -STOP $$; sleep 60")[1].wait(10) == 128 + signal.SIGHUP
