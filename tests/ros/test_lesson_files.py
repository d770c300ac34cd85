"""check_lesson.py reports each problem of a pupil's package in one sentence."""

import re
from pathlib import Path

import pytest
from catkin_pkg.package import InvalidPackage

from jetbot_lessons import files

PACKAGES = Path(__file__).parents[2] / "morbot_ws/src"

PACKAGE_XML = """<package format="3"><name>mine</name><version>0.0.1</version><description>Mine.</description>
<maintainer email="me@example.com">Me</maintainer><license>MIT</license>
<depend>rospy</depend><depend>geometry_msgs</depend></package>"""
SCRIPT = "#!/usr/bin/env python3\nprint()\n"
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>'


def exists(package):
    return files.check_exists(package, "make it")


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
    assert exists("mine") is None
    assert files.check_depends("mine", "rospy", "geometry_msgs") is None
    assert files.check_scripts("mine") is None
    assert files.check_built("mine") is None
    assert files.check_launch_files("mine") is None


def test_no_package(mine):
    assert exists("yours") == f"There is no package yours in {mine.parent}: make it"


@pytest.mark.parametrize("given", ["Mine", "scenarios/mine", "/mine/"])
def test_another_name(mine, given):
    assert exists(given) == f"There is no package {given}, but there is mine: type that name"


@pytest.mark.parametrize("place", ["..", "other"])
def test_package_where_ros_does_not_search(mine, place):
    source = mine.parent
    (source / "other").mkdir()
    (source / "other/package.xml").write_text(PACKAGE_XML.replace("mine", "other"))
    elsewhere = (source / place / "mine").resolve()
    mine.rename(elsewhere)
    assert exists("mine") == (
        f"ROS does not search {elsewhere.parent} for packages: mv {elsewhere} {source}")


@pytest.mark.parametrize("file, check, problem", [
    ("package.xml", exists, "{0} has no package.xml: mv {0} ~, then make it"),
    ("CMakeLists.txt", exists, "{0} has no CMakeLists.txt: mv {0} ~, then make it"),
    ("scripts/drive.py", files.check_scripts,
     "There is no script in {0}/scripts: put one there, with a name that ends in .py"),
    ("launch/drive.launch", files.check_launch_files,
     "There is no launch file in {0}/launch: put one there, with a name that ends in .launch")])
def test_missing_file(mine, file, check, problem):
    (mine / file).unlink()
    assert check("mine") == problem.format(mine)


def test_package_described_as_another(mine):
    (mine / "package.xml").write_text(PACKAGE_XML.replace("mine", "yours"))
    assert exists("mine") == (
        f"{mine}/package.xml names another package: write <name>mine</name> there, and project(mine) in CMakeLists.txt")


def test_not_built(mine):
    (mine.parents[1] / "devel").rename(mine.parents[1] / "elsewhere")
    assert files.check_built("mine") == "mine is not built: ./morbot setup"


def test_dependency_is_not_named(mine):
    assert files.check_depends("mine", "rospy", "jetbot_control_node") == (
        f"{mine}/package.xml does not name jetbot_control_node: add <exec_depend>jetbot_control_node</exec_depend> "
        "before </package>")


@pytest.mark.parametrize("text", [
    "<package", "", "hello", "<launch/>", '<?xml version="1.0" encoding="foo"?><a/>', "\xff"])
def test_package_xml_is_not_xml(mine, text):
    (mine / "package.xml").write_bytes(text.encode("latin-1"))
    file = re.escape(f"{mine}/package.xml")
    with pytest.raises(InvalidPackage, match=rf"^(Error.* '{file}': The manifest|{file} cannot be read:) [^\n]+$"):
        exists("mine")


def test_package_xml_is_incomplete(mine):
    (mine / "package.xml").write_text("<package><name>mine</name></package>")
    assert re.fullmatch(rf"Error.* '{mine}/package.xml': [^\n]+", files.check_depends("mine", "rospy"))


@pytest.mark.parametrize("text, sentence", [
    ("print()\n", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    ("", "drive.py does not begin with #!/usr/bin/env python3: make that the first line of {}"),
    (SCRIPT.replace("\n", "\r\n"), r"drive.py has Windows line endings: sed -i 's/\r$//' {}"),
    *((f"{first}\n", f"drive.py begins with {first}, which does not start ROS's Python: write #!/usr/bin/env python3")
      for first in ("#!/usr/bin/env snake", "#!/usr/bin/env python9", "#!usr/bin/env python3", "#!/usr/bin/env",
                    "#!/bin/nothing", "#!/bin/sh", "#!"))])
def test_script_that_does_not_start(mine, text, sentence):
    script = mine / "scripts/drive.py"
    script.write_bytes(text.encode())
    assert files.check_scripts("mine") == sentence.format(script)


@pytest.mark.parametrize("line, where", [
    ("while True", "line 3 of "), ("if 1:\nprint()", "line 4 of "), ("\0", r"(line \d of )?")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / "scripts/drive.py").write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"Python cannot read {where}drive\.py: [^\n]+", files.check_scripts("mine"))


def test_script_that_cannot_be_read(mine):
    script = mine / "scripts/drive.py"
    script.unlink()
    script.symlink_to("nowhere")
    assert files.check_scripts("mine") == f"{script} is not a file: remove it"


@pytest.mark.parametrize("name", [".drive.py", ".#drive.py", "notes.txt"])
def test_hidden_and_other_files_are_no_scripts(mine, name):
    (mine / "scripts" / name).symlink_to("nowhere")
    assert files.check_scripts("mine") is None


@pytest.mark.parametrize("first", ["#!/usr/bin/env python3 ", "#!/usr/bin/python3 -u", "#!/usr/bin/env -S python3 -u"])
def test_first_lines_that_start(mine, first):
    (mine / "scripts/drive.py").write_text(f"{first}\nprint()\n")
    assert files.check_scripts("mine") is None


def test_script_is_not_executable(mine):
    script = mine / "scripts/drive.py"
    script.chmod(0o644)
    assert files.check_scripts("mine") == f"drive.py is not executable: chmod +x {script}"


@pytest.mark.parametrize("text, problem", [
    ("<launch/>", f"does not include the controller: add {INCLUDE} below <launch>"),
    (f"<launch>{INCLUDE.replace('true', 'false')}</launch>",
     'does not pass its arguments on to the controller: write pass_all_args="true" in its <include>'),
    ("<launch>", "is not XML: no element found: line 1, column 8")])
def test_launch_file_without_the_controller(mine, text, problem):
    launch = mine / "launch/drive.launch"
    launch.write_text(text)
    assert files.check_launch_files("mine") == f"{launch} {problem}"


@pytest.mark.parametrize("package", ["jetbot_control_node", "jetbot_lessons", "workshop"])
def test_packages_of_this_project_are_complete(monkeypatch, package):
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(PACKAGES))
    assert files.check_depends(package, "rospy", "geometry_msgs") is None
    assert files.check_scripts(package) is None
