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
    monkeypatch.setattr(run, "ENDING_TIMEOUT", 0.5)
    with socket.create_server(("localhost", 0)) as server:
        port = server.getsockname()[1]
        if answer:
            threading.Thread(target=answer_all, args=[server, answer], daemon=True).start()
        assert sentence.format(port) in run.master_problem(str(port))


def test_a_master_that_is_just_ending_is_no_problem(monkeypatch):
    server = socket.create_server(("localhost", 0))
    port = server.getsockname()[1]
    threading.Thread(target=answer_all, args=[server, b"\r\n"], daemon=True).start()
    monkeypatch.setattr(run, "is_master", lambda uri: server.shutdown(socket.SHUT_RDWR) or server.close())
    assert run.master_problem(str(port)) is None


def test_a_file_is_named_by_its_whole_path(monkeypatch, tmp_path):
    (tmp_path / "my.yaml").touch()
    monkeypatch.chdir(tmp_path)
    words = ["config:=my.yaml", "config:=none.yaml", "linear:=0.2"]
    assert list(map(run.with_whole_path, words)) == [f"config:={tmp_path}/my.yaml", *words[1:]]


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


def test_the_page_of_the_cockpit_gets_the_first_port_that_is_free(monkeypatch):
    with socket.create_server(("localhost", 0)) as other:
        taken = other.getsockname()[1]
        monkeypatch.setattr(run, "PORTS", range(taken, taken + 100))
        chosen, = run.cockpit_port([("linear", "0.2"), ("cockpit_port", "")])
        assert taken < int(chosen.partition(":=")[2]) < taken + 100
    assert run.cockpit_port([]) == [f"cockpit_port:={taken}"]
    assert run.cockpit_port([("cockpit_port", "9000")]) == []
