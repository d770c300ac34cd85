"""./morbot run refuses mistyped words and a master that is none, and finds the reason why a node has ended."""

import contextlib
import signal
import socket
import threading
from types import SimpleNamespace

import pytest

import run
from conftest import SIMULATION, SOURCE
from jetbot_ros import launch_arguments

signal.signal(signal.SIGINT, signal.default_int_handler)  # which run changes

LAUNCH = ["simulation", "simulation.launch", "motion:=true"]


@pytest.fixture(autouse=True)
def packages(monkeypatch):
    folders = {"simulation": SIMULATION, "jetbot_control_node": SOURCE,
               "workshop": SOURCE.parent / "scenarios/workshop"}
    monkeypatch.setattr(launch_arguments, "package_folder", lambda name: str(folders.get(name, "")))


@pytest.mark.parametrize("typed", [
    "linear=0.2", "linear:0.2", "linear: =0.2", "linear :=0.2", "linear:= 0.2", "linear = 0.2", "linear 0.2",
    "lineer=0.2"])
def test_a_word_that_is_no_argument_is_refused_with_what_was_meant(typed):
    assert run.word_problem([*LAUNCH, *typed.split()]) == (
        f"morbot: there is no argument {typed}. Did you mean linear:=0.2?")


def test_only_the_word_that_is_wrong_is_named():
    assert "no argument rviz=no. Did you mean rviz:=no?" in run.word_problem(
        [*LAUNCH, "-p", "11312", "--screen", "linear:=0.2", "rviz=no"])
    assert "no argument fast. An argument is name:=value" in run.word_problem([*LAUNCH, "fast"])


@pytest.mark.parametrize("typed", ["", "linear:=0.2", "linear:=", "-p 11312 linear:=0.2", "--screen -v __ns:=red"])
def test_what_roslaunch_takes_is_not_refused(typed):
    assert run.word_problem([*LAUNCH, *typed.split()]) is None


@pytest.mark.parametrize("uri", ["localhost:11311", "http://localhost", "11311", "http://localhost:x"])
def test_an_address_that_is_none(monkeypatch, uri):
    monkeypatch.setenv("ROS_MASTER_URI", uri)
    assert run.master_problem("") == f"morbot: ROS_MASTER_URI must look like http://localhost:11311, not {uri}"


def answer_all(server, answer):
    connections = []
    with contextlib.suppress(OSError):  # the end of the test
        while True:
            connections.append(server.accept()[0])
            connections[-1].sendall(answer)


@pytest.mark.parametrize("answer, sentence", [
    (b"", "the ROS master at http://localhost:{} does not answer. Is it frozen (Ctrl-Z)?"),
    (b"SSH-2.0\r\n", "another program than a ROS master listens at http://localhost:{}.")], ids=["frozen", "other"])
def test_a_master_that_does_not_answer(monkeypatch, answer, sentence):
    monkeypatch.setattr(run, "MASTER_TIMEOUT", 1.0)
    with socket.create_server(("localhost", 0)) as server:
        port = server.getsockname()[1]
        if answer:
            threading.Thread(target=answer_all, args=[server, answer], daemon=True).start()
        assert sentence.format(port) in run.master_problem(str(port))


def test_the_reason_of_a_node_is_the_last_fatal_line_of_this_start(tmp_path):
    launch = pytest.importorskip("launch")  # it needs ROS
    log = tmp_path / "node.log"
    fatal = "[rosout][CRITICAL] 2020-01-01 12:00:00,000: {}\n"
    start = "[rospy.client][INFO] 2020-01-01 12:00:00,000: init_node, name[/jetbot_controller], pid[{}]\n"
    log.write_text(start.format(1) + fatal.format("old") + start.format(2))
    process = SimpleNamespace(args=["node.py", f"__log:={log}"], pid=2)
    assert launch.fatal_line(process) is None
    with log.open("a") as file:
        file.write(fatal.format("There is no I2C bus /dev/i2c-7: what now?") + "[rospy.core][INFO] the end\n")
    assert launch.fatal_line(process) == "There is no I2C bus /dev/i2c-7: what now?"
    assert launch.fatal_line(SimpleNamespace(args=["node.py"], pid=2)) is None


@pytest.mark.parametrize("error, interrupted, code", [
    (BrokenPipeError(), False, 141), (RuntimeError("could not contact master"), True, 130)])
def test_a_start_that_is_cut_short_ends_without_a_traceback(error, interrupted, code):
    launch = pytest.importorskip("launch")
    with pytest.raises(SystemExit) as end, launch.quiet_end(lambda: interrupted):
        raise error
    assert end.value.code == code


def test_a_start_that_fails_by_itself_is_reported():
    launch = pytest.importorskip("launch")
    with pytest.raises(RuntimeError), launch.quiet_end(lambda: False):
        raise RuntimeError
