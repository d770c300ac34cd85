"""check_lesson.py reads its arguments, and reports each problem of the running system in one sentence."""

import runpy
import subprocess
import sys
from pathlib import Path

import pytest

from jetbot_lessons import graph

SCRIPT = Path(__file__).parents[2] / "morbot_ws/src/jetbot_lessons/scripts/check_lesson.py"


@pytest.fixture(scope="module")
def lesson():
    """The function that reads check_lesson.py's arguments."""
    return runpy.run_path(str(SCRIPT))["lesson"]


@pytest.mark.parametrize("arguments", [[], ["0"], ["9"], ["one"], ["-1"], ["\u00b2"], ["1", "mine", "yours"]])
def test_no_such_lesson(lesson, arguments):
    with pytest.raises(SystemExit, match=r"^Which lesson, 1 to 8\? Type: rosrun jetbot_lessons check_lesson\.py N, and "
                                         "from lesson 7 on the name of your package$"):
        lesson(arguments)


@pytest.mark.parametrize("number", ["7", "8"])
def test_lesson_needs_a_package(lesson, number):
    sentence = (rf"Lesson {number} is about your own package\. "
                rf"Type: rosrun jetbot_lessons check_lesson\.py {number} ITS_NAME")
    with pytest.raises(SystemExit, match=f"^{sentence}$"):
        lesson([number])


def test_lesson_and_package(lesson):
    assert lesson(["3"]) == (3,)
    assert lesson(["8", "mine"]) == (8, "mine")


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """The folder of a package."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    folder = tmp_path / "mine"
    (folder / "scripts").mkdir(parents=True)
    (folder / "package.xml").write_text("<package><name>mine</name></package>")
    return folder


@pytest.fixture
def running(monkeypatch):
    """A graph in which /robot subscribes to /cmd_vel, /mine publishes on /speed and /other on /cmd_vel."""
    now = graph.Graph({"/speed": ["/mine"], "/cmd_vel": ["/other"], "/rosout": ["/mine"]},
                      {"/cmd_vel": ["/robot"]})
    monkeypatch.setattr(graph, "snapshot", lambda: now)
    monkeypatch.setattr(graph, "pid", lambda node: None if node == "/other" else 1)
    monkeypatch.setattr(graph, "command_of", lambda node: [Path(f"/devel/lib{node}/drive.py")])
    return monkeypatch


def test_nothing_is_missing_in_the_graph(mine, running):
    assert graph.check_node("/robot", "rosrun it") is None
    assert graph.check_subscribes("/robot", "/cmd_vel") is None
    assert graph.check_type("/cmd_vel", "geometry_msgs/Twist") is None
    assert graph.check_no_other_publisher("/nothing") is None
    assert graph.check_no_other_publisher("/speed", "mine") is None
    assert graph.check_no_other_publisher("/cmd_vel") is None, "the other publisher is dead"
    assert graph.check_publishes("mine", "/speed", "rosrun it") is None


@pytest.mark.parametrize("check, arguments, problem", [
    (graph.check_node, ("/nobody", "rosrun it"),
     "There is no node /nobody: start it in another terminal with rosrun it"),
    (graph.check_node, ("/other", "rosrun it"),
     "The node /other does not answer: stop it (after Ctrl-Z: fg, then Ctrl-C), then start it with rosrun it"),
    (graph.check_subscribes, ("/robot", "/speed"),
     "/robot does not subscribe to /speed: was it started in a namespace, or was /speed remapped?"),
    (graph.check_publishes, ("mine", "/cmd_vel", "rosrun it"),
     "/mine publishes on /speed, not on /cmd_vel: use that in rospy.Publisher")])
def test_problem_in_the_graph(mine, running, check, arguments, problem):
    assert check(*arguments) == problem


def test_another_type(running):
    running.setattr(graph, "ask", lambda node, method: [["/cmd_vel", "std_msgs/String"]])
    assert graph.check_type("/cmd_vel", "geometry_msgs/Twist") == (
        "/other publishes std_msgs/String on /cmd_vel, not geometry_msgs/Twist: stop it with Ctrl-C in its terminal; "
        "in a script of your own, pass that type to rospy.Publisher")


def test_node_in_a_namespace(running):
    running.setattr(graph, "snapshot", lambda: graph.Graph({}, {"/red/cmd_vel": ["/red/robot"]}))
    assert graph.check_node("/robot", "rosrun it") == "/red/robot runs in a namespace: start it without one"


@pytest.mark.parametrize("package", [None, "mine"])
def test_somebody_else_publishes(mine, running, package):
    running.setattr(graph, "pid", lambda node: 1)
    assert graph.check_no_other_publisher("/cmd_vel", package) == (
        "/other publishes on /cmd_vel: stop it with Ctrl-C in its terminal, then try again")


def test_node_does_not_run(mine, running):
    running.setattr(graph, "command_of", lambda node: [])
    assert graph.check_publishes("mine", "/cmd_vel", "rosrun it") == (
        "No node of mine runs; /other was killed or hangs (fg, then Ctrl-C, stops it): "
        "start it in another terminal with rosrun it; if it ends by itself, that terminal shows why")


def test_launch_file_runs_one_of_two_packages(running):
    running.setattr(graph, "launched", lambda: [{"robot", "mine"}, {"other"}])
    assert graph.check_launched_together("robot", "mine") is None
    assert graph.check_launched_together("robot", "other") == (
        "No launch file runs robot and other: stop what runs, and start it with roslaunch; if you did so, "
        "read its output, and check pkg and type of each <node>")


@pytest.mark.parametrize("path, whose", [
    ("/ws/devel/lib/mine/drive.py", True), ("{}/scripts/drive.py", True),
    ("/home/mine/ws/devel/lib/yours/drive.py", False), ("/ws/yours/scripts/drive.py", False)])
def test_whose_script_it_is(mine, path, whose):
    assert graph.belongs([Path("/usr/bin/python3"), Path(path.format(mine))], "mine") is whose


@pytest.fixture
def command_of(mine, monkeypatch):
    """A function that starts Python with arguments in a folder, as a node, and returns its command."""
    def start(folder, *arguments):
        process = subprocess.Popen([sys.executable, *arguments], cwd=folder, stdin=subprocess.PIPE,
                                   stdout=subprocess.PIPE)
        process.stdout.readline()  # it runs
        monkeypatch.setattr(graph, "pid", lambda node: process.pid)
        command = graph.command_of("/mine")
        process.communicate(b"\n")
        return command

    return start


def test_argument_is_not_taken_for_the_script(mine, command_of):
    assert "pub" not in {path.name for path in command_of(mine, "-c", "print(flush=True); input()", "pub")}


@pytest.mark.parametrize("command, folder", [
    ("drive.py", "scripts"), ("./drive.py", "scripts"), ("../mine/scripts/drive.py", "."),
    ("{}/scripts/drive.py", "/")])
def test_where_a_script_was_started(mine, command_of, command, folder):
    (mine / "scripts/drive.py").write_text("print(flush=True)\ninput()")
    assert graph.belongs(command_of(mine / folder, command.format(mine)), "mine")
