"""What check_lesson.py says of a pupil's package and of the running system: one sentence for each thing missing."""

import re
import runpy
import subprocess
import sys
from pathlib import Path

import pytest
from catkin_pkg.package import InvalidPackage

from jetbot_lessons import files, graph

SOURCE = Path(__file__).parents[2] / "morbot_ws/src/jetbot_control_node"
LESSONS = SOURCE.parent / "jetbot_lessons"

PACKAGE_XML = """<package format="3"><name>mine</name><version>0.0.1</version><description>Mine.</description>
<maintainer email="me@example.com">Me</maintainer><license>MIT</license>
<depend>rospy</depend><depend>geometry_msgs</depend></package>"""
SCRIPT = "#!/usr/bin/env python3\nprint()\n"
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>'


@pytest.fixture(scope="module")
def lesson():
    """What check_lesson.py makes of its arguments."""
    return runpy.run_path(str(LESSONS / "scripts/check_lesson.py"))["lesson"]


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
    """The folder of a package with nothing missing."""
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src"))
    monkeypatch.setenv("CMAKE_PREFIX_PATH", str(tmp_path / "devel"))
    (tmp_path / "devel/share/mine/cmake").mkdir(parents=True)
    folder = tmp_path / "src/mine"
    for name in ("scripts", "launch"):
        (folder / name).mkdir(parents=True)
    (folder / "package.xml").write_text(PACKAGE_XML)
    (folder / "CMakeLists.txt").touch()
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


@pytest.mark.parametrize("given", ["Mine", "scenarios/mine", "/mine/"])
def test_another_name(mine, given):
    assert files.found(given, "make it") == f"There is no package {given}, but there is mine: type that name"


@pytest.mark.parametrize("place", ["..", "other"])
def test_package_where_ros_does_not_look(mine, place):
    source = mine.parent
    (source / "other").mkdir()
    (source / "other/package.xml").write_text(PACKAGE_XML.replace("mine", "other"))
    elsewhere = (source / place / "mine").resolve()
    mine.rename(elsewhere)
    assert files.found("mine", "make it") == f"{elsewhere} lies where ROS does not look: mv {elsewhere} {source}"


def test_package_without_its_description(mine):
    (mine / "package.xml").unlink()
    assert files.found("mine", "make it") == f"{mine} has no package.xml: mv {mine} ~, then make it"


def test_package_described_as_another(mine):
    (mine / "package.xml").write_text(PACKAGE_XML.replace("mine", "yours"))
    assert files.found("mine", "make it") == (
        f"{mine}/package.xml names another package: write <name>mine</name> there, and project(mine) in CMakeLists.txt")


def test_not_built(mine):
    (mine.parents[1] / "devel").rename(mine.parents[1] / "elsewhere")
    assert files.built("mine") == "mine is not built: ./morbot setup"


def test_package_that_catkin_cannot_build(mine):
    (mine / "CMakeLists.txt").unlink()
    assert files.found("mine", "make it") == f"{mine} has no CMakeLists.txt: mv {mine} ~, then make it"


def test_dependency_is_not_named(mine):
    assert files.depends("mine", "rospy", "jetbot_control_node") == (
        f"{mine}/package.xml does not name jetbot_control_node: add <exec_depend>jetbot_control_node</exec_depend> "
        "before </package>")


@pytest.mark.parametrize("text", [
    "<package", "", "hello", "<launch/>", '<?xml version="1.0" encoding="foo"?><a/>', "\xff"])
def test_package_xml_is_not_xml(mine, text):
    (mine / "package.xml").write_bytes(text.encode("latin-1"))
    file = re.escape(f"{mine}/package.xml")
    with pytest.raises(InvalidPackage, match=rf"^(Error.* '{file}': The manifest|{file} cannot be read:) [^\n]+$"):
        files.found("mine", "make it")


def test_package_xml_says_too_little(mine):
    (mine / "package.xml").write_text("<package><name>mine</name></package>")
    assert re.fullmatch(rf"Error.* '{mine}/package.xml': [^\n]+", files.depends("mine", "rospy"))


def test_no_script(mine):
    (mine / "scripts/drive.py").unlink()
    assert files.scripts_start("mine") == (
        f"There is no script in {mine}/scripts: put one there, with a name that ends in .py")


@pytest.mark.parametrize("text, sentence", [
    ("print()\n", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    ("", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    (SCRIPT.replace("\n", "\r\n"), r"drive.py has line ends of Windows: sed -i 's/\r$//' {}"),
    *((f"{first}\n", f"drive.py begins with {first}, which does not start ROS's Python: write #!/usr/bin/env python3")
      for first in ("#!/usr/bin/env snake", "#!/usr/bin/env python9", "#!usr/bin/env python3", "#!/usr/bin/env",
                    "#!/bin/nothing", "#!/bin/sh", "#!"))])
def test_script_that_does_not_start(mine, text, sentence):
    script = mine / "scripts/drive.py"
    script.write_bytes(text.encode())
    assert files.scripts_start("mine") == sentence.format(script)


@pytest.mark.parametrize("line, where", [
    ("while True", "line 3 of "), ("if 1:\nprint()", "line 4 of "), ("\0", r"(line \d of )?")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / "scripts/drive.py").write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"Python cannot read {where}drive\.py: [^\n]+", files.scripts_start("mine"))


def test_script_that_cannot_be_read(mine):
    script = mine / "scripts/drive.py"
    script.unlink()
    script.symlink_to("nowhere")
    assert files.scripts_start("mine") == f"{script} is no file: remove it"


@pytest.mark.parametrize("name", [".drive.py", ".#drive.py", "notes.txt"])
def test_hidden_and_other_files_are_no_scripts(mine, name):
    (mine / "scripts" / name).symlink_to("nowhere")
    assert files.scripts_start("mine") is None


@pytest.mark.parametrize("first", ["#!/usr/bin/env python3 ", "#!/usr/bin/python3 -u", "#!/usr/bin/env -S python3 -u"])
def test_first_lines_that_start(mine, first):
    (mine / "scripts/drive.py").write_text(f"{first}\nprint()\n")
    assert files.scripts_start("mine") is None


def test_script_is_not_executable(mine):
    script = mine / "scripts/drive.py"
    script.chmod(0o644)
    assert files.scripts_start("mine") == f"drive.py is not executable: chmod +x {script}"


def test_no_launch_file(mine):
    (mine / "launch/drive.launch").unlink()
    assert files.launch_file_includes_controller("mine") == (
        f"There is no launch file in {mine}/launch: put one there, with a name that ends in .launch")


def test_launch_file_without_the_controller(mine):
    (mine / "launch/drive.launch").write_text("<launch/>")
    assert files.launch_file_includes_controller("mine") == (
        f"{mine}/launch/drive.launch does not include the controller: add {INCLUDE} below <launch>")


def test_launch_file_that_keeps_its_arguments(mine):
    (mine / "launch/drive.launch").write_text(f"<launch>{INCLUDE.replace('true', 'false')}</launch>")
    assert files.launch_file_includes_controller("mine") == (
        f"{mine}/launch/drive.launch passes no arguments on to the controller: "
        'write pass_all_args="true" into its <include>')


def test_launch_file_is_not_xml(mine):
    (mine / "launch/drive.launch").write_text("<launch>")
    assert files.launch_file_includes_controller("mine") == (
        f"{mine}/launch/drive.launch is not XML: no element found: line 1, column 8")


@pytest.mark.parametrize("package", [SOURCE, LESSONS], ids=lambda folder: folder.name)
def test_the_workshops_packages_are_complete(monkeypatch, package):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(package.parent))
    assert files.depends(package.name, "rospy", "geometry_msgs") is None
    assert files.scripts_start(package.name) is None


@pytest.fixture
def running(monkeypatch):
    """A graph in which /robot listens to /cmd_vel, /mine publishes on /speed and /other on /cmd_vel."""
    now = graph.Graph({"/speed": ["/mine"], "/cmd_vel": ["/other"], "/rosout": ["/mine"]},
                      {"/cmd_vel": ["/robot"]})
    monkeypatch.setattr(graph, "look", lambda: now)
    monkeypatch.setattr(graph, "pid", lambda node: None if node == "/other" else 1)
    monkeypatch.setattr(graph, "command_of", lambda node: [Path(f"/devel/lib{node}/drive.py")])
    return monkeypatch


def test_nothing_is_missing_in_the_graph(mine, running):
    assert graph.node_up("/robot", "rosrun it") is None
    assert graph.listens("/robot", "/cmd_vel") is None
    assert graph.has_type("/cmd_vel", "geometry_msgs/Twist") is None
    assert not graph.nobody_else_publishes("/nothing")
    assert not graph.nobody_else_publishes("/speed", "mine")
    assert not graph.nobody_else_publishes("/cmd_vel"), "it only has died"
    assert graph.publishes("mine", "/speed", "rosrun it") is None


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
    running.setattr(graph, "ask", lambda node, question: [["/cmd_vel", "std_msgs/String"]])
    assert graph.has_type("/cmd_vel", "geometry_msgs/Twist") == (
        "/other publishes std_msgs/String on /cmd_vel, not geometry_msgs/Twist: end it with Ctrl-C in its terminal; "
        "a script of yours must name that type in rospy.Publisher")


def test_node_in_a_namespace(running):
    running.setattr(graph, "look", lambda: graph.Graph({}, {"/red/cmd_vel": ["/red/robot"]}))
    assert graph.node_up("/robot", "rosrun it") == "/red/robot runs in a namespace: start it without one"


@pytest.mark.parametrize("package", [None, "mine"])
def test_somebody_else_publishes(mine, running, package):
    running.setattr(graph, "pid", lambda node: 1)
    assert graph.nobody_else_publishes("/cmd_vel", package) == (
        "/other publishes on /cmd_vel: end it with Ctrl-C in its terminal, then try again")


def test_what_runs_in_the_packages_folder_need_not_be_of_it(mine, monkeypatch):
    process = subprocess.Popen([sys.executable, "-c", "print(flush=True); input()", "pub"], cwd=mine,
                               stdin=subprocess.PIPE, stdout=subprocess.PIPE)
    process.stdout.readline()
    monkeypatch.setattr(graph, "pid", lambda node: process.pid)
    paths = graph.command_of("/mine")
    process.communicate(b"\n")
    assert "pub" not in {path.name for path in paths}


def test_another_topic(mine, running):
    assert graph.publishes("mine", "/cmd_vel", "rosrun it") == (
        "/mine publishes on /speed, not on /cmd_vel: name that in rospy.Publisher")


def test_node_does_not_run(mine, running):
    running.setattr(graph, "command_of", lambda node: [])
    assert graph.publishes("mine", "/cmd_vel", "rosrun it") == (
        "No node of mine runs; /other was killed or hangs (fg, then Ctrl-C, ends it): "
        "start it in another terminal with rosrun it; where it ends by itself, that terminal tells why")


def test_launch_file_starts_one_of_two(running):
    running.setattr(graph, "launched", lambda: [{"robot", "mine"}, {"other"}])
    assert graph.launched_together("robot", "mine") is None
    assert graph.launched_together("robot", "other") == (
        "No launch file runs robot and other: end what runs, and start it with roslaunch; where you did so, "
        "read what it shows, and look at pkg and type of each <node>")


@pytest.mark.parametrize("path, whose", [
    ("/ws/devel/lib/mine/drive.py", True), ("{}/scripts/drive.py", True),
    ("/home/mine/ws/devel/lib/yours/drive.py", False), ("/ws/yours/scripts/drive.py", False)])
def test_whose_script_it_is(mine, path, whose):
    assert graph.belongs([Path("/usr/bin/python3"), Path(path.format(mine))], "mine") is whose


@pytest.mark.parametrize("command, folder", [
    ("drive.py", "scripts"), ("./drive.py", "scripts"), ("../mine/scripts/drive.py", "."),
    ("{}/scripts/drive.py", "/")])
def test_where_a_script_was_started(mine, monkeypatch, command, folder):
    (mine / "scripts/drive.py").write_text("print(flush=True)\ninput()")
    process = subprocess.Popen([sys.executable, command.format(mine)], cwd=mine / folder, stdin=subprocess.PIPE,
                               stdout=subprocess.PIPE)
    process.stdout.readline()  # it runs
    try:
        monkeypatch.setattr(graph, "pid", lambda node: process.pid)
        assert graph.belongs(graph.command_of("/mine"), "mine")
    finally:
        process.communicate(b"\n")
