"""What check_lesson.py says of a pupil's package and of the running system: one sentence for each thing missing."""

import re
import runpy
from pathlib import Path

import pytest

from lessons import files, graph

SOURCE = Path(__file__).parents[2] / "morbot_ws/src/jetbot_control_node"
WORKSHOP = SOURCE.parent / "scenarios/workshop"

PACKAGE_XML = """<package format="3"><name>mine</name><version>0.0.1</version><description>Mine.</description>
<maintainer email="me@example.com">Me</maintainer><license>MIT</license>
<depend>rospy</depend><depend>geometry_msgs</depend></package>"""
SCRIPT = "#!/usr/bin/env python3\nprint()\n"
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>'


@pytest.fixture(scope="module")
def lesson():
    """What check_lesson.py makes of its arguments."""
    return runpy.run_path(str(WORKSHOP / "scripts/check_lesson.py"))["lesson"]


@pytest.mark.parametrize("arguments", [[], ["0"], ["9"], ["one"], ["-1"], ["\u00b2"], ["1", "mine", "yours"]])
def test_no_such_lesson(lesson, arguments):
    with pytest.raises(SystemExit, match=r"^Which lesson, 1 to 8\? Type: rosrun workshop check_lesson\.py N$"):
        lesson(arguments)


@pytest.mark.parametrize("number", ["7", "8"])
def test_lesson_needs_a_package(lesson, number):
    sentence = rf"Lesson {number} is about your own package\. Type: rosrun workshop check_lesson\.py {number} ITS_NAME"
    with pytest.raises(SystemExit, match=f"^{sentence}$"):
        lesson([number])


def test_lesson_and_package(lesson):
    assert lesson(["3"]) == (3,)
    assert lesson(["8", "mine"]) == (8, "mine")


@pytest.fixture
def mine(tmp_path, monkeypatch):
    """The folder of a package with nothing missing."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path))
    monkeypatch.setenv("CMAKE_PREFIX_PATH", str(tmp_path / "devel"))
    (tmp_path / "devel/share/mine/cmake").mkdir(parents=True)
    folder = tmp_path / "mine"
    for name in ("scripts", "launch"):
        (folder / name).mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE_XML)
    (folder / "launch/drive.launch").write_text(f"<launch>{INCLUDE}</launch>")
    (folder / "scripts/drive.py").write_text(SCRIPT)
    (folder / "scripts/drive.py").chmod(0o755)
    return folder


def test_nothing_is_missing(mine):
    assert files.found("mine", "make it") is None
    assert files.depends("mine", "rospy", "geometry_msgs") is None
    assert files.scripts_start("mine") is None
    assert files.built("mine") is None
    assert files.launch_file_includes_controller("mine") is None


def test_no_package(mine):
    assert files.found("yours", "make it") == f"There is no package yours in {mine.parent}: make it"


def test_not_built(mine):
    (mine.parent / "devel").rename(mine.parent / "elsewhere")
    assert files.built("mine") == "mine is not built: ./morbot setup"


def test_dependency_is_not_named(mine):
    assert files.depends("mine", "rospy", "jetbot_control_node") == (
        f"{mine}/package.xml does not name jetbot_control_node: add <exec_depend>jetbot_control_node</exec_depend>")


@pytest.mark.parametrize("text", ["<package", "", "hello"])
def test_package_xml_is_not_xml(mine, text):
    (mine / "package.xml").write_text(text)
    assert re.fullmatch(rf"{mine}/package.xml is not XML: [^\n]+", files.found("mine", "make it"))


def test_package_xml_says_too_little(mine):
    (mine / "package.xml").write_text("<package><name>mine</name></package>")
    assert re.fullmatch(rf"{mine}/package.xml cannot be read: [^\n]+", files.depends("mine", "rospy"))


def test_no_script(mine):
    (mine / "scripts/drive.py").unlink()
    assert files.scripts_start("mine") == f"mine has no script: put one into {mine}/scripts"


@pytest.mark.parametrize("text, sentence", [
    ("print()\n", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    ("", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    (SCRIPT.replace("\n", "\r\n"), r"drive.py has line ends of Windows: sed -i 's/\r$//' {}"),
    ("#!/usr/bin/env snake\n", "drive.py begins with #!/usr/bin/env snake, and there is no snake here: "
                               "write #!/usr/bin/env python3"),
    ("#!/bin/nothing\n", "drive.py begins with #!/bin/nothing, and there is no /bin/nothing here: "
                         "write #!/usr/bin/env python3")])
def test_script_that_does_not_start(mine, text, sentence):
    script = mine / "scripts/drive.py"
    script.write_bytes(text.encode())
    assert files.scripts_start("mine") == sentence.format(script)


@pytest.mark.parametrize("line, where", [
    ("while True", ", line 3"), ("if 1:\nprint()", ", line 4"), ("\0", r"(, line \d)?")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / "scripts/drive.py").write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"drive\.py is no Python that can be read{where}: [^\n]+", files.scripts_start("mine"))


def test_script_is_not_executable(mine):
    script = mine / "scripts/drive.py"
    script.chmod(0o644)
    assert files.scripts_start("mine") == f"drive.py is not executable: chmod +x {script}"


def test_no_launch_file(mine):
    (mine / "launch/drive.launch").unlink()
    assert files.launch_file_includes_controller("mine") == f"mine has no launch file: put one into {mine}/launch"


@pytest.mark.parametrize("text", ["<launch/>", f"<launch>{INCLUDE.replace('true', 'false')}</launch>"])
def test_launch_file_without_the_controller(mine, text):
    (mine / "launch/drive.launch").write_text(text)
    assert files.launch_file_includes_controller("mine") == (
        f"{mine}/launch/drive.launch does not include the controller and pass its arguments on: add {INCLUDE}")


def test_launch_file_is_not_xml(mine):
    (mine / "launch/drive.launch").write_text("<launch>")
    assert files.launch_file_includes_controller("mine") == (
        f"{mine}/launch/drive.launch is not XML: no element found: line 1, column 8")


@pytest.mark.parametrize("package", [SOURCE, WORKSHOP], ids=lambda folder: folder.name)
def test_the_workshops_packages_are_complete(monkeypatch, package):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))
    assert files.depends(package.name, "rospy", "geometry_msgs") is None
    assert files.scripts_start(package.name) is None


@pytest.fixture
def running(monkeypatch):
    """A graph in which /robot listens to /cmd_vel, /mine publishes on /speed and /other on /cmd_vel."""
    now = graph.Graph({"/speed": ["/mine"], "/cmd_vel": ["/other"], "/rosout": ["/mine"]},
                      {"/cmd_vel": ["/robot"]}, {"/cmd_vel": "geometry_msgs/Twist"})
    monkeypatch.setattr(graph, "look", lambda: now)
    monkeypatch.setattr(graph, "pid", lambda node: None if node == "/other" else 1)
    monkeypatch.setattr(graph, "command_of", lambda node: ["python3", f"/devel/lib{node}/drive.py"])
    return monkeypatch


def test_nothing_is_missing_in_the_graph(mine, running):
    assert graph.node_up("/robot", "rosrun it") is None
    assert graph.listens("/robot", "/cmd_vel") is None
    assert graph.has_type("/cmd_vel", "geometry_msgs/Twist") is None
    assert graph.nobody_publishes("/nothing") is None
    assert graph.publishes("mine", "/speed") is None


def test_no_node(running):
    assert graph.node_up("/nobody", "rosrun it") == (
        "There is no node /nobody: start it in another terminal with rosrun it")


def test_node_that_does_not_answer(running):
    assert graph.node_up("/other", "rosrun it") == (
        "The node /other does not answer: end it (after Ctrl-Z: fg, then Ctrl-C), then start it with rosrun it")


def test_node_that_does_not_listen(running):
    assert graph.listens("/robot", "/speed") == (
        "/robot does not listen to /speed: was it started in a namespace, or /speed remapped?")


def test_another_type(running):
    assert graph.has_type("/cmd_vel", "std_msgs/String") == (
        "/cmd_vel carries geometry_msgs/Twist, not std_msgs/String: which node publishes that?")


def test_somebody_else_publishes(running):
    assert graph.nobody_publishes("/cmd_vel") == (
        "/other publishes on /cmd_vel: end it with Ctrl-C in its terminal, then try again")


def test_another_topic(mine, running):
    assert graph.publishes("mine", "/cmd_vel") == (
        "/mine publishes on /speed, not on /cmd_vel: name that in rospy.Publisher")


def test_node_does_not_run(mine, running):
    running.setattr(graph, "command_of", lambda node: [])
    assert graph.publishes("mine", "/cmd_vel") == (
        "No node of mine runs: start it in another terminal with rosrun mine, or by its launch file")


def test_launch_file_starts_one_of_two(running):
    running.setattr(graph, "launched", lambda: [{"robot", "mine"}, {"other"}])
    assert graph.launched_together("robot", "mine") is None
    assert graph.launched_together("robot", "other") == (
        "No launch file runs robot and other: end what rosrun started, and start it with roslaunch")


@pytest.mark.parametrize("command, whose", [
    ("/ws/devel/lib/mine/drive.py", True), ("{}/scripts/drive.py", True),
    ("/home/mine/ws/devel/lib/yours/drive.py", False), ("/ws/yours/scripts/drive.py", False)])
def test_whose_script_it_is(mine, command, whose):
    assert graph.belongs(["python3", command.format(mine)], "mine") is whose
