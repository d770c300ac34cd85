"""check_lesson.py reads its arguments, and reports each problem of the running system in one sentence."""

import os
import queue
import runpy
import socket
import subprocess
import sys
from pathlib import Path

import pytest
from geometry_msgs.msg import Twist

from jetbot.fake.bus import power_on
from jetbot_lessons import graph, motion
from jetbot_lessons.lessons import LAST
from jetbot_lessons.motion import check_command
from jetbot_ros import processes
from jetbot_ros.state import RobotState
from lesson_package import made_package  # noqa: F401  a fixture

SCRIPT = Path(__file__).parents[2] / "morbot_ws/src/jetbot_lessons/scripts/check_lesson.py"
parse = runpy.run_path(str(SCRIPT))["parse"]
FROZEN = "does not answer: continue it (after Ctrl-Z: fg), or stop it and start it with roscore"
MOVING = RobotState("driving", "driving")
WAITING = RobotState("stopped", "stopped: no command yet", "no_command_yet")
STOPPED = RobotState("stopped", "stopped: emergency stop", "emergency_stop", holds=("emergency_stop",))
STOP_IT = "stop it with Ctrl-C in its terminal"
CHECK = "rosrun jetbot_lessons check_lesson.py"


@pytest.mark.parametrize("arguments, problem", [
    *((words, f"Which lesson, 1 to {LAST}? Type: {CHECK} N, and from lesson 7 on the name of your package")
      for words in ("", "0", str(LAST + 1), "one")),
    *((number, f"Lesson {number} is about your own package. Type: {CHECK} {number} ITS_NAME") for number in "79"),
    ("1 mine yours", "Unrecognized arguments: yours. Type: "), ("1 --color", "Unrecognized arguments: --color. Type: "),
    ("9 --folders ada --csv metre.bag", "Argument --csv: its name must end in .csv, not metre.bag. Type: "),
    ("9 --folders ada --csv /nowhere/a.csv", "Argument --csv: /nowhere/a.csv cannot be written: "),
    ("9 --robots red", "Lesson 9 cannot be checked like this. Type: "),
    ("6 --folders ada", "Lesson 6 cannot be checked like this. Type: "),
    ("3 --csv a.csv", "Lesson 3 cannot be checked like this. Type: ")])
def test_what_cannot_be_meant_is_refused(tmp_path, monkeypatch, arguments, problem):
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit) as ended:
        parse(arguments.split())
    assert str(ended.value).startswith(problem) and "\n" not in str(ended.value)


@pytest.mark.parametrize("arguments, options", [
    ("3", {"lesson": 3, "package": None}), ("8 mine", {"lesson": 8, "package": "mine"}),
    ("3 --robots red blue", {"lesson": 3, "robots": ["red", "blue"]}),
    ("9 --folders ada ben", {"lesson": 9, "folders": ["ada", "ben"]})])
def test_what_is_checked(arguments, options):
    assert {**vars(parse(arguments.split())), **options} == vars(parse(arguments.split()))


def test_ctrl_c_while_it_imports(tmp_path):
    (tmp_path / "rosgraph.py").write_text("import os, signal\nos.kill(os.getpid(), signal.SIGINT)\n")
    done = subprocess.run([sys.executable, str(SCRIPT), "1"], stderr=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONPATH": str(tmp_path)}, check=False)
    assert (done.returncode, done.stderr) == (-2, "")


@pytest.mark.parametrize("error, problem", [
    (socket.timeout, f"The ROS master at http://localhost:1 {FROZEN}"),
    (ConnectionRefusedError, "No ROS master at http://localhost:1: start one in another terminal with roscore")])
def test_a_master_that_is_frozen_or_missing(monkeypatch, error, problem):
    def ask(*_):
        raise error

    monkeypatch.setenv("ROS_MASTER_URI", "http://localhost:1")
    monkeypatch.setattr(graph, "ask_master", ask)
    assert graph.check_master() == problem


def test_a_master_that_freezes_ends_the_check(monkeypatch):
    answers, problems = iter([None, None, "busy", None, "frozen", "frozen"]), queue.Queue()
    monkeypatch.setattr(graph, "check_master", lambda: next(answers))
    monkeypatch.setattr(graph, "ASK_INTERVAL", 0.0)
    graph.report_loss(problems.put)
    assert problems.get(timeout=10) == "frozen" and not list(answers)


@pytest.fixture
def running(mine, monkeypatch):
    """A graph in which /dead does not answer, and two roslaunches run robot and mine, and other."""
    publishers = {"/cmd_vel": ["/mine/drive", "/dead", "/other"], "/speed": ["/mine/drive", "/mine/again"],
                  "/map": ["/dead"], "/rosout": ["/mine/again"]}
    monkeypatch.setattr(graph, "system_state", lambda: [publishers, {"/cmd_vel": ["/robot"]}, {}])
    monkeypatch.setattr(graph, "is_alive", lambda node: node in graph.nodes() and node != "/dead")
    monkeypatch.setattr(graph, "command_of", lambda node: [Path(f"/devel/lib{node}")])
    monkeypatch.setattr(graph, "launched", lambda namespace: [{"robot", "mine"}, {"other"}])
    return publishers


@pytest.mark.parametrize("check, arguments, problem", [
    (graph.check_node, ("/robot", "rosrun it"), None),
    (graph.check_node, ("/bus", "rosrun it"), "There is no node /bus: start it in another terminal with rosrun it"),
    (graph.check_node, ("/dead", "rosrun it"), "The node /dead was killed or hangs: start it again with rosrun it; "
     "if it hangs, stop it first (after Ctrl-Z: fg, then Ctrl-C)"),
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
    (graph.check_launched_together, ("robot", "mine"), None),
    (graph.check_launched_together, ("robot", "other"),
     "No launch file runs robot and other: stop what runs, and start it with roslaunch; if you did so, "
     "read its output, and check pkg and type of each <node>")])
def test_problem_in_the_graph(running, check, arguments, problem):
    assert check(*arguments) == problem


@pytest.mark.parametrize("command, publishers, problem", [
    (["/devel/lib/mine/drive"], {"/rosout": ["/mine/drive"]},
     "/mine/drive has no rospy.Publisher: make one for /cmd_vel, and call its publish in a loop"),
    ([], {"/cmd_vel": ["/mine/drive", "/dead"]},
     "No node of mine runs; /dead was killed or hangs (fg, then Ctrl-C, stops it): "
     "start it in another terminal with rosrun it; if it ends by itself, that terminal shows why")])
def test_node_that_publishes_nothing_or_does_not_run(running, monkeypatch, command, publishers, problem):
    running.clear()
    running.update(publishers)
    monkeypatch.setattr(graph, "command_of", lambda node: list(map(Path, command)))
    assert graph.check_publishes("mine", "/cmd_vel", "rosrun it") == problem


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
        monkeypatch.setattr(processes, "address_of", lambda node: "http://localhost:1/")
        monkeypatch.setattr(processes, "ask", lambda server, method: process.pid)
        command = processes.command_of("/mine")
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


@pytest.mark.parametrize("x, z, problem", [
    (0.0, -0.01, None), (0.0, -0.2, None),
    (0.5, 0.0, "has linear.x 0.5, so the robot drives forward: leave linear.x at 0"),
    (-0.5, -0.05, "has linear.x -0.5, so the robot drives backward: leave linear.x at 0"),
    (0.0, 0.05, "has angular.z 0.05, which turns the robot to the left: write a number below 0"),
    (0.0, 0.0, "has angular.z 0, which turns no wheel: write -0.01 or less"),
    (0.0, -0.5, "has angular.z -0.5, which is fast: write a number between -0.2 and 0")])
def test_whether_a_command_turns_the_robot_on_the_spot_right_and_slowly(x, z, problem):
    said = check_command(x, z)
    assert said is None if problem is None else said.startswith(f"Your command {problem}")


@pytest.fixture
def motors(monkeypatch, tmp_path):
    """What the controller of a robot on a fake bus reports about its motors; its wheels stand."""
    values = {"bus": f"fake:{tmp_path}/bus", "board": "jetbot", "settings": "no file of settings"}
    power_on(tmp_path / "bus")
    monkeypatch.setattr(motion, "init_node", lambda: None)
    monkeypatch.setattr(motion, "motor_diagnostics", lambda namespace: values)
    monkeypatch.setattr(motion, "RESPONSE_TIMEOUT", 0.0)
    return values


@pytest.mark.parametrize("state, settings, problem", [
    (MOVING, "", "The wheels do not turn, and the controller reports 'driving'; was it started with a parameter "
     "such as invert_left?"),
    (MOVING, "settings from a.yaml", "The wheels do not turn, and the controller reports 'driving'; it has settings "
     "from a.yaml: start it without that file"),
    (STOPPED, "", "The wheels do not turn, and the controller reports 'stopped: emergency stop'; "
     "release it with rostopic pub -1 /emergency_stop std_msgs/Bool false"),
    (WAITING, "", "The wheels do not turn, and the controller reports 'stopped: no command yet'")])
def test_why_the_wheels_do_not_turn(motors, monkeypatch, state, settings, problem):
    motors["settings"] = settings
    monkeypatch.setattr(motion, "state_of", lambda namespace: state)
    assert motion.check_wheels_turn() == problem


@pytest.mark.parametrize("count, problem", [
    (0, "The program that publishes on /cmd_vel sends nothing: stop it with Ctrl-C, and repeat your command "),
    (1, "Your command arrives only once: stop it with Ctrl-C, and repeat your command "),
    (10, "The wheels do not follow your command: at x 0 and z -0.05 they turn at 0.00 and 0.00, not 0.05 and -0.05, ")])
def test_wheels_that_do_not_obey(motors, monkeypatch, count, problem):
    command = Twist()
    command.angular.z = -0.05
    monkeypatch.setattr(motion, "record_commands", lambda topic: [(0.0, command)] * count)
    monkeypatch.setattr(motion, "state_of", lambda namespace: MOVING)
    assert motion.check_turn().startswith(problem)


@pytest.mark.parametrize("x, z, problem", [
    (0.5, 0.5, None), (50, 0, "Your program commands linear.x 50 and angular.z 0, and a wheel has no more than full ")])
def test_a_command_that_no_wheel_can_obey(monkeypatch, x, z, problem):
    command = Twist()
    command.linear.x, command.angular.z = x, z
    monkeypatch.setattr(motion.rospy, "wait_for_message", lambda topic, kind, timeout: command)
    assert (motion.check_power("/cmd_vel") or "").startswith(problem or "")
    assert bool(motion.check_power("/cmd_vel")) == bool(problem)


@pytest.mark.parametrize("times, problem", [
    ([0.1 * n for n in range(15)], None),
    ([0.2 * n for n in range(8)], "mine publishes 5.0 times a second, not 10 times a second: fix"),
    ([0.0], "mine publishes at most once a second, not 10 times a second: fix"),
    ([], "mine publishes nothing, not 10 times a second: fix")])
def test_rate_of_the_commands(monkeypatch, times, problem):
    monkeypatch.setattr(motion, "record_commands", lambda topic: [(time, None) for time in times])
    assert motion.check_rate("mine", 10, "fix", "/cmd_vel") == problem
