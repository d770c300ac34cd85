"""Where a system has no packages of ROS 1, ./morbot runs in a container; with fake container engines."""

import os
import signal
import socket
import subprocess
import sys

import pytest

from conftest import ROOT

pytestmark = pytest.mark.shell
MORBOT, ATTEND = ROOT / "morbot", ROOT / "docker/attend"
WITHOUT_ROS = ["sh", "-c", MORBOT.read_text().replace("is_installed ||", "reason=nothing;"), MORBOT]
FEDORA = 'ID=fedora\nVERSION_ID=40\nPRETTY_NAME="Fedora Linux 40"\n'
JETPACK_4 = 'ID=ubuntu\nID_LIKE=debian\nVERSION_CODENAME=bionic\nPRETTY_NAME="Ubuntu 18.04.6 LTS"\n'
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


def started(commands):
    """Return the command line that starts a container, framed by spaces."""
    return f" {next(line for line in commands if line.split()[1] == 'run')} "


def name_of(commands):
    """Return the name of the container that is started."""
    return started(commands).partition("--name ")[2].split()[0]


def test_the_first_command_builds_the_image_and_starts_the_container_that_later_ones_share(morbot):
    code, printed, commands = morbot("run", "linear:=0.2", docker=WORKING)
    assert code == 0
    assert printed.startswith("morbot: Fedora Linux 40 has no packages of ROS 1; running in a container of docker\n")
    assert commands[-1].startswith(f"docker exec -i --workdir {ROOT}/docs")
    assert commands[-1].endswith(f" {MORBOT} run linear:=0.2")
    _, _, later = morbot("shell", docker=WORKING)
    assert not [line for line in later if line.split()[1] in ("build", "run")]
    assert f" {name_of(commands)} {ATTEND} " in later[-1]


def test_podman_is_installed_where_apt_has_it_and_no_engine_is_there(morbot):
    code, printed, commands = morbot("run", system=UBUNTU_26, uid=0)
    assert code == 0
    assert "morbot: Ubuntu 26.04 LTS has no packages of ROS 1; installing podman, to run in a container\n" in printed
    assert commands[-1].startswith("podman exec ")


def test_a_stop_does_not_wait_until_podman_is_installed(morbot):
    code, printed, _ = morbot("stop", system=UBUNTU_26, uid=0)
    assert code == 1 and "installing" not in printed


def test_the_container_has_this_folder_the_users_settings_network_and_processes(morbot, tmp_path):
    options = started(morbot("shell", docker=WORKING)[2])
    for option in (f"--volume {ROOT}:{ROOT}", f"--volume {tmp_path}/home/.ros:{tmp_path}/home/.ros", "--network host",
                   "--pid host", "--user 1234:1234", f"--env HOME={tmp_path}/home"):
        assert f" {option} " in options


@pytest.mark.parametrize("docker", [MISSING, PODMAN], ids=["podman", "a docker that is podman"])
def test_a_podman_without_root_keeps_the_users_id(morbot, docker):
    commands = morbot("shell", docker=docker, podman=PODMAN)[2]
    assert commands[-1].startswith("podman exec ")
    assert " --user 1234:1234 --userns keep-id --group-add keep-groups " in started(commands)


def plug_in(host, *names):
    """Give this computer devices that everybody may open; return their paths."""
    (host / "dev").mkdir(parents=True, exist_ok=True)
    for name in names:
        (host / "dev" / name).symlink_to("/dev/null")
    return [host / "dev" / name for name in names]


def test_the_container_has_motor_boards_and_cameras_with_the_groups_that_may_open_them(morbot, tmp_path):
    devices = plug_in(tmp_path / "host", "i2c-1", "ttyACM0", "ttyUSB1", "video0", "video10")
    options = started(morbot("shell", docker=WORKING)[2])
    for device in devices:
        assert f" --device {device} --group-add {os.stat(device).st_gid} " in options


def test_what_was_plugged_in_later_is_in_a_further_container_for_which_no_stop_waits(morbot, tmp_path):
    first = morbot("shell", docker=WORKING)[2]
    camera, = plug_in(tmp_path / "host", "video0")
    stop = morbot("stop", docker=WORKING)[2]
    assert f" {name_of(first)} {ATTEND} " in stop[-1] and not [line for line in stop if line.split()[1] == "run"]
    assert f" --device {camera} " in started(morbot("shell", docker=WORKING)[2])


@pytest.fixture
def jetson(tmp_path):
    """Make this computer one whose daemon for the camera runs; return the daemon's socket."""
    path = tmp_path / "host/tmp/argus_socket"
    path.parent.mkdir(parents=True)
    bind(path)
    return path


def bind(path):
    with socket.socket(socket.AF_UNIX) as daemon:
        daemon.bind(os.path.relpath(path))  # a socket's path may have 107 characters


NVIDIA = "--env NVIDIA_VISIBLE_DEVICES=all --env NVIDIA_DRIVER_CAPABILITIES=all"


@pytest.mark.parametrize("engine, file, options", [
    ({"docker": WORKING, "RUNTIMES": "nvidia:{} runc:{}"}, "", f" --runtime nvidia {NVIDIA} --volume {{0}}:{{0}} "),
    ({"podman": PODMAN}, "etc/cdi/nvidia.yaml", " --device nvidia.com/gpu=all --volume {0}:{0} "),
    ({"podman": PODMAN}, "run/cdi/nvidia.yaml", " --device nvidia.com/gpu=all --volume {0}:{0} ")])
def test_a_jetsons_camera_is_reached_by_its_daemon(morbot, jetson, tmp_path, engine, file, options):
    if file:
        (tmp_path / "host" / file).parent.mkdir(parents=True)
        (tmp_path / "host" / file).write_text("kind: nvidia.com/gpu\n")
    assert options.format(jetson) in started(morbot("shell", **engine)[2])


@pytest.mark.parametrize("runtimes, cannot, sentence", [
    ("runc:{}", "nothing", ""), ("nvidia:{} runc:{}", "--runtime nvidia", "morbot: docker cannot give the Jetson's "
     "camera to the container (see above); trying without it\n")], ids=["no toolkit", "it does not start"])
def test_without_nvidias_libraries_a_jetson_drives_without_its_camera(morbot, jetson, runtimes, cannot, sentence):
    code, printed, commands = morbot("shell", docker=WORKING, RUNTIMES=runtimes, CANNOT=cannot)
    assert code == 0 and sentence in printed and commands[-1].startswith("docker exec ")
    assert "argus" not in [line for line in commands if line.split()[1] == "run"][-1]


def test_a_daemon_of_the_camera_that_was_restarted_is_in_a_further_container(morbot, jetson):
    morbot("shell", docker=WORKING, RUNTIMES="nvidia:{}")
    os.rename(jetson, jetson.with_name("old"))  # keeps its inode
    bind(jetson)
    assert started(morbot("shell", docker=WORKING, RUNTIMES="nvidia:{}")[2])


@pytest.mark.parametrize("system, server, base", [
    (FEDORA, "24.0.5", "docker.io/library/debian:bookworm-slim"),
    (FEDORA, "20.10.5", "docker.io/library/ros:noetic-ros-base-focal"),
    (JETPACK_4, "24.0.5", "docker.io/library/ros:noetic-ros-base-focal")])
def test_the_image_is_one_that_the_docker_can_run(morbot, system, server, base):
    commands = morbot("shell", system=system, docker={**WORKING, "server": server})[2]
    build, = (line for line in commands if line.startswith("docker build"))
    assert f" BASE={base} --target system " in build


@pytest.mark.parametrize("engines, sentence", [
    ({}, NO_ROS + "with docker or podman, it runs in a container: https://podman.io/docs/installation\n"),
    ({"docker": {**WORKING, "ps": "echo 'permission denied while trying to connect' >&2; exit 1"}},
     NO_ROS + "docker is there, but closed to you: sudo usermod -aG docker pupil, and log in again\n"),
    ({"docker": {**WORKING, "ps": "echo 'Is the docker daemon running?' >&2; exit 1"}},
     NO_ROS + "docker is there, but not running: sudo systemctl enable --now docker\n"),
    ({"podman": {**PODMAN, "ps": "exit 125"}}, NO_ROS + "podman is there, but does not work; see: podman ps\n"),
    ({"docker": {**WORKING, "build": "echo no network; false"}},
     "no network\nmorbot: cannot build the image (see above); the first use needs the internet\n")],
    ids=["none", "closed", "not running", "does not work", "no network"])
def test_without_a_container_one_sentence_says_what_to_do(morbot, engines, sentence):
    code, printed, commands = morbot("run", **engines)
    assert code == 1 and printed.endswith(sentence)
    assert not [line for line in commands if line.split()[1] == "run" or f" {MORBOT} " in line]


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
