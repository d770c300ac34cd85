"""./morbot run and class refuse mistyped words, a second start and another user's master, and then are roslaunch."""

import signal
import socket

import pytest

pytest.importorskip("roslaunch")
import run  # noqa: E402

signal.signal(signal.SIGINT, signal.default_int_handler)  # which run changes

KNOWN = {"linear", "rviz", "i2c_bus"}
NO_NUMBER = '<node name="a" pkg="b" type="c"><param name="linear" type="double" value="abc"/></node>'


@pytest.mark.parametrize("word, sentence", [
    ("lineer:=0.2", "there is no argument lineer. Did you mean linear:=0.2?"),
    ("linear=0.2", "there is no argument linear=0.2. Did you mean linear:=0.2?"),
    ("linear:0.2", "there is no argument linear:0.2. Did you mean linear:=0.2?"),
    ("_i2c_bus:=fake", "there is no argument _i2c_bus. Did you mean i2c_bus:=fake?"),
    ("linear", "there is no argument linear. Did you mean linear:=VALUE?"),
    ("0.2", "there is no argument 0.2. An argument is NAME:=VALUE, without spaces, such as linear:=0.2"),
    ("foo:=3", "there is no argument foo. An argument is NAME:=VALUE, without spaces, such as linear:=0.2"),
    *((word, None) for word in ("linear:=0.2", "linear:=", "__ns:=red"))])
def test_a_word_that_is_no_argument_is_refused_with_what_was_meant(word, sentence):
    assert run.word_problem(["rviz:=no", word], KNOWN) == sentence


def launch_file(tmp_path, content):
    (tmp_path / "pupil.launch").write_text(f"<launch>{content}</launch>")
    return str(tmp_path), str(tmp_path / "pupil.launch")


def test_the_names_are_those_of_all_files_that_are_read(tmp_path, monkeypatch):
    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    (tmp_path / "other.launch").write_text('<launch><arg name="board" default=""/></launch>')
    _, file = launch_file(tmp_path, '<include file="$(dirname)/other.launch" pass_all_args="true"/>')
    monkeypatch.setattr(run.roslaunch.rlutil, "resolve_launch_arguments", lambda words: [words[1]])
    assert "Did you mean board:=x?" in run.problem_of("any", file, ["bord:=x"])
    assert run.problem_of("any", file, ["board:=x"]) is None


@pytest.mark.parametrize("content, part", [("<arg", "Invalid roslaunch XML syntax"),
                                           ('<include file="$(find no_such)/x.launch"/>', "the package no_such is "),
                                           (NO_NUMBER, "linear:= is a number, and not 'abc'")])
def test_a_launch_file_that_cannot_be_read_is_one_problem(tmp_path, monkeypatch, content, part):
    monkeypatch.setattr(run.roslaunch.rlutil, "resolve_launch_arguments", lambda words: [words[1]])
    assert part in run.problem_of("any", launch_file(tmp_path, content)[1], [])


def test_a_master_of_another_user_is_named_with_the_export_that_helps(monkeypatch):
    monkeypatch.setattr(run, "processes_on", lambda port: [])
    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setattr(run, "MASTER", f"http://localhost:{server.getsockname()[1]}")
        monkeypatch.setenv("ROS_MASTER_URI", run.MASTER)  # as ROS's own setup.sh does
        assert "another user's" in run.start_problem([]) and "export ROS_MASTER_URI=" in run.start_problem([])
        monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
        assert run.start_problem([]) is None, "the master that is asked for is used"


def test_a_node_that_runs_is_refused(monkeypatch):
    monkeypatch.setattr(run, "is_others_master", lambda: False)
    monkeypatch.setattr(run, "is_reachable", lambda uri: True)
    monkeypatch.setattr(run, "require_master", lambda: None)

    def require_name(name):
        if name == "/jetbot_controller":
            raise SystemExit("it runs")

    monkeypatch.setattr(run, "require_name", require_name)
    assert run.start_problem(["/jetbot_simulator", "/jetbot_controller"]) == "it runs"
    assert run.start_problem(["/jetbot_simulator"]) is None


def test_a_file_is_named_by_its_whole_path(monkeypatch, tmp_path):
    (tmp_path / "my.yaml").touch()
    monkeypatch.chdir(tmp_path)
    words = ["config:=my.yaml", "config:=none.yaml", "linear:=0.2"]
    assert list(map(run.whole_path, words)) == [f"config:={tmp_path}/my.yaml", *words[1:]]


def test_then_it_is_roslaunch_and_the_cockpits_page_gets_the_first_free_port(monkeypatch, capsys):
    started = []
    monkeypatch.setattr(run.sys, "argv", ["run.py"])
    monkeypatch.setattr(run, "problem_of", lambda *_: None)
    monkeypatch.setattr(run.os, "execvp", lambda *arguments: started.append(arguments))
    with socket.create_server(("localhost", 0)) as other:
        taken = other.getsockname()[1]
        monkeypatch.setattr(run, "PORTS", range(taken, taken + 100))
        for typed in ["cockpit:=true"], ["cockpit:=true", "cockpit_port:=9000"], ["robots:=2"]:
            run.main("a robot", "any", "any.launch", *typed)
    assert {(program, *words[:4]) for program, words in started} == {
        ("roslaunch", "roslaunch", "--no-summary", "any", "any.launch")}
    (_, chosen), *given = [words[4:] for _, words in started]
    assert taken < int(chosen.partition(":=")[2]) < taken + 100
    assert given == [["cockpit:=true", "cockpit_port:=9000"], ["robots:=2"]]
    assert capsys.readouterr().out.startswith("morbot: a robot; Ctrl-C ends it\n")
