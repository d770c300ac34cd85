"""check_lesson.py reads its arguments, and reports each problem of the running system in one sentence."""

import os
import queue
import runpy
import signal
import socket
import subprocess
import sys
from pathlib import Path

import pytest
import rosgraph

from jetbot_lessons import graph, master, nodes, packages
from jetbot_lessons.class_options import parse_class

SCRIPT = Path(__file__).parents[2] / "morbot_ws/src/jetbot_lessons/scripts/check_lesson.py"
parse_arguments = runpy.run_path(str(SCRIPT))["parse_arguments"]
FROZEN = "does not answer: continue it (after Ctrl-Z: fg), or stop it and start it with roscore"
STOP_IT = "stop it with Ctrl-C in its terminal"


@pytest.mark.parametrize("arguments", [[], ["0"], ["10"], ["one"], ["-1"], ["\u00b2"], ["1", "mine", "yours"]])
def test_no_such_lesson(arguments):
    with pytest.raises(SystemExit, match=r"^Which lesson, 1 to 9\? Type: rosrun jetbot_lessons check_lesson\.py N, and "
                                         "from lesson 7 on the name of your package$"):
        parse_arguments(arguments)


@pytest.mark.parametrize("arguments, problem", [
    ("9 --folders ada --csv metre.bag", "Argument --csv: its name must end in .csv, not metre.bag"),
    ("9 --folders ada --csv /nowhere/a.csv", "Argument --csv: /nowhere/a.csv cannot be written: "),
    ("9 --robots red", "Lesson 9 cannot be checked like this"), ("6 --folders ada", "Lesson 6 cannot be checked like")])
def test_options_for_a_class_that_cannot_be_meant_so(arguments, problem):
    with pytest.raises(SystemExit) as ended:
        parse_class(arguments.split(), "check_lesson.py")
    assert str(ended.value).startswith(problem)
    assert ". Type: check_lesson.py N --robots NAME ... for lessons 2 to 6, " in str(ended.value)


@pytest.mark.parametrize("number", ["7", "9"])
def test_lesson_needs_a_package(number):
    with pytest.raises(SystemExit, match=rf"^Lesson {number} is about your own package\. "
                                         rf"Type: rosrun jetbot_lessons check_lesson\.py {number} ITS_NAME$"):
        parse_arguments([number])


def test_lesson_and_package():
    assert parse_arguments(["3"]) == (3,)
    assert parse_arguments(["8", "mine"]) == (8, "mine")


def check(**options):
    """Run check_lesson.py 1; return its exit code and what it reports."""
    done = subprocess.run([sys.executable, str(SCRIPT), "1"], stderr=subprocess.PIPE, text=True, **options)
    return done.returncode, done.stderr


@pytest.mark.parametrize("open_output, reason", [
    (lambda: open("/dev/full", "w"), "No space left on device"), (lambda: closed_pipe(), "Broken pipe")])
def test_result_that_cannot_be_printed(open_output, reason, tmp_path):
    with open_output() as output:
        (tmp_path / "lesson_1.txt").write_text("rospy geometry_msgs jetbot_control_node")
        result = check(stdout=output, env={**os.environ, "PYTHONUNBUFFERED": ""}, cwd=tmp_path)
        assert result == (1, f"Lesson 1: the result cannot be printed: {reason}\n")


def closed_pipe():
    reading, writing = os.pipe()
    os.close(reading)
    return os.fdopen(writing, "w")


def test_ctrl_c_while_it_imports(tmp_path):
    (tmp_path / "rosgraph.py").write_text(f"import os\nos.kill(os.getpid(), {signal.SIGINT})\n")
    assert check(env={**os.environ, "PYTHONPATH": str(tmp_path)}) == (-signal.SIGINT, "")


@pytest.fixture
def silent_master(monkeypatch):
    """The address of a port that accepts connections, and answers nothing."""
    monkeypatch.setattr(nodes, "TIMEOUT", 0.2)
    with socket.create_server(("localhost", 0)) as server:
        uri = f"http://localhost:{server.getsockname()[1]}"
        monkeypatch.setenv("ROS_MASTER_URI", uri)
        yield uri


def test_frozen_master(silent_master):
    assert master.check_master("roscore") == f"The ROS master at {silent_master} {FROZEN}"


def test_master_that_freezes_ends_the_check(silent_master, monkeypatch):
    answers, problems = iter([True, True, False, False]), queue.Queue()
    monkeypatch.setattr(master, "is_online", lambda: next(answers))
    monkeypatch.setattr(master, "ASK_INTERVAL", 0.0)
    master.report_loss(problems.put)
    assert problems.get(timeout=10) == f"The ROS master at {silent_master} {FROZEN}"


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """The folder of a package."""
    monkeypatch.setattr(packages, "workspace", lambda: tmp_path)
    folder = tmp_path / "mine"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>mine</name></package>")
    return folder


@pytest.fixture
def running(mine, monkeypatch):
    """A graph in which /dead does not answer, /speed is a String, and two roslaunches run robot and mine, and other."""
    now = graph.Graph({"/cmd_vel": ["/mine/drive", "/dead", "/other"], "/speed": ["/mine/drive", "/mine/again"],
                       "/map": ["/dead"], "/rosout": ["/mine/again"]},
                      {"/cmd_vel": ["/robot"], "/red/cmd_vel": ["/red/car"]})
    monkeypatch.setattr(graph, "snapshot", lambda: now)
    monkeypatch.setattr(graph, "pid", lambda node: 1 if node in now.nodes and node != "/dead" else None)
    monkeypatch.setattr(graph, "command_of", lambda node: [Path(f"/devel/lib{node}")])
    monkeypatch.setattr(graph, "ask", lambda node, method: [["/speed", "std_msgs/String"]])
    monkeypatch.setattr(graph, "launched", lambda namespace: [{"robot", "mine"}, {"other"}])
    return monkeypatch


@pytest.mark.parametrize("check, arguments, problem", [
    (graph.check_node, ("/car", "rosrun it"), "/red/car runs in a namespace: start it without one"),
    (graph.check_subscribes, ("/robot", "/speed"),
     "/robot does not subscribe to /speed: was it started in a namespace, or was /speed remapped?"),
    (graph.check_no_other_publisher, ("/cmd_vel",), f"/mine/drive publishes on /cmd_vel: {STOP_IT}, then try again"),
    (graph.check_no_other_publisher, ("/cmd_vel", "mine"), f"/other publishes on /cmd_vel: {STOP_IT}, then try again"),
    (graph.check_no_other_publisher, ("/speed", "mine"), f"/mine/again publishes on /speed: {STOP_IT}, then try again"),
    (graph.check_no_other_publisher, ("/map",), None),
    (graph.check_commanded, ("/speed", "do it"),
     "/mine/drive and /mine/again publish on /speed: stop all but one of them with Ctrl-C in their terminals"),
    (graph.check_commanded, ("/map", "do it"), "Nobody publishes on /map, but /dead was killed or hangs "
     "(fg, then Ctrl-C, stops it): do it"),
    (graph.check_commanded, ("/odom", "do it"), "Nobody publishes on /odom: do it"),
    (graph.check_publishes, ("mine", "/cmd_vel", "rosrun it"), None),
    (graph.check_publishes, ("mine", "/map", "rosrun it"),
     "/mine/again publishes on /speed, not on /map: use that in rospy.Publisher"),
    (graph.check_type, ("/speed", "geometry_msgs/Twist"), "/mine/drive publishes std_msgs/String on /speed, "
     f"not geometry_msgs/Twist: {STOP_IT}; in a script of your own, pass that type to rospy.Publisher"),
    (graph.check_launched_together, ("robot", "mine"), None),
    (graph.check_launched_together, ("robot", "other"),
     "No launch file runs robot and other: stop what runs, and start it with roslaunch; if you did so, "
     "read its output, and check pkg and type of each <node>")])
def test_problem_in_the_graph(running, check, arguments, problem):
    assert check(*arguments) == problem


def test_node_without_a_publisher(running):
    running.setattr(graph, "snapshot", lambda: graph.Graph({"/rosout": ["/mine/drive"]}, {}))
    assert graph.check_publishes("mine", "/cmd_vel", "rosrun it") == (
        "/mine/drive has no rospy.Publisher: make one for /cmd_vel, and call its publish in a loop")


def test_node_does_not_run(running):
    running.setattr(graph, "command_of", lambda node: [])
    assert graph.check_publishes("mine", "/cmd_vel", "rosrun it") == (
        "No node of mine runs; /dead was killed or hangs (fg, then Ctrl-C, stops it): "
        "start it in another terminal with rosrun it; if it ends by itself, that terminal shows why")


@pytest.mark.parametrize("path, whose", [
    ("/ws/devel/lib/mine/drive.py", True), ("/home/mine/ws/devel/lib/yours/drive.py", False),
    ("/ws/yours/scripts/drive.py", False)])
def test_whose_script_it_is(mine, path, whose):
    assert graph.belongs([Path("/usr/bin/python3"), Path(path)], "mine") is whose


@pytest.fixture
def command_of(mine, monkeypatch):
    """A function that starts Python with arguments in a folder, as a node, and returns its command."""
    def start(folder, *arguments):
        process = subprocess.Popen([sys.executable, *arguments], cwd=folder, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE)
        process.stdout.readline()  # it runs
        monkeypatch.setattr(rosgraph.Master, "lookupNode", lambda *_: "http://localhost:1/")
        monkeypatch.setattr(nodes, "pid", lambda node: process.pid)
        monkeypatch.setattr(nodes, "_listener", lambda uri: Path("/proc", str(process.pid)))
        command = nodes.command_of("/mine")
        process.communicate(b"\n")
        return command

    return start


def test_argument_is_not_taken_for_the_script(mine, command_of):
    assert "pub" not in {path.name for path in command_of(mine, "-c", "print(flush=True); input()", "pub")}


@pytest.mark.parametrize("command, folder", [
    ("drive.py", "scripts"), ("../mine/scripts/drive.py", "."), ("{}/scripts/drive.py", "/")])
def test_where_a_script_was_started(mine, command_of, command, folder):
    (mine / "scripts/drive.py").write_text("print(flush=True)\ninput()")
    assert graph.belongs(command_of(mine / folder, command.format(mine)), "mine")
