"""check_lesson.py reports each problem of a pupil's package in one sentence."""

import os
import re

import pytest
from catkin_pkg.package import InvalidPackage

from jetbot_lessons import files

PACKAGE_XML = """<package format="3"><name>mine</name><version>0.0.1</version><description>Mine.</description>
<maintainer email="me@example.com">Me</maintainer><license>MIT</license>
<depend>rospy</depend><depend>geometry_msgs</depend></package>"""
DRIVE, LAUNCH = "scripts/drive.py", "launch/drive.launch"
SCRIPT = "#!/usr/bin/env python3\nprint()\n"
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>'


def exists(package):
    return files.check_exists(package, "make it")


def depends(package):
    return files.check_depends(package, "rospy", "geometry_msgs")


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
    (folder / LAUNCH).write_text(f"<launch>{INCLUDE}</launch>")
    (folder / DRIVE).write_text(SCRIPT)
    (folder / DRIVE).chmod(0o755)
    return folder


def test_nothing_is_missing(mine):
    for check in exists, depends, files.check_scripts, files.check_built, files.check_launch_files:
        assert check("mine") is None


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
    assert exists("mine") == f"ROS does not search {elsewhere.parent} for packages: mv {elsewhere} {source}"


@pytest.mark.parametrize("file, text, check, problem", [
    ("package.xml", None, exists, "{0} has no package.xml: mv {0} ~, then make it"),
    ("CMakeLists.txt", None, exists, "{0} has no CMakeLists.txt: mv {0} ~, then make it"),
    ("package.xml", PACKAGE_XML.replace("mine", "yours"), exists, "{0}/package.xml names another package: "
     "write <name>mine</name> there, and project(mine) in CMakeLists.txt"),
    ("package.xml", PACKAGE_XML.replace("<depend>geometry_msgs</depend>", ""), depends, "{0}/package.xml does not name "
     "geometry_msgs: add <exec_depend>geometry_msgs</exec_depend> before </package>"),
    (LAUNCH, None, files.check_launch_files,
     "There is no launch file in {0}/launch: put one there, with a name that ends in .launch"),
    (LAUNCH, "<launch/>", files.check_launch_files,
     f"{{0}}/{LAUNCH} does not include the controller: add {INCLUDE} below <launch>"),
    (LAUNCH, f"<launch>{INCLUDE.replace('true', 'false')}</launch>", files.check_launch_files, f"{{0}}/{LAUNCH} "
     'does not pass its arguments on to the controller: write pass_all_args="true" in its <include>'),
    (LAUNCH, "<launch>", files.check_launch_files, f"{{0}}/{LAUNCH} is not XML: no element found: line 1, column 8"),
    (DRIVE, None, files.check_scripts,
     "There is no script in {0}/scripts: put one there, with a name that ends in .py"),
    *((DRIVE, text, files.check_scripts,
       f"drive.py does not begin with #!/usr/bin/env python3: make that the first line of {{0}}/{DRIVE}")
      for text in ("print()\n", "")),
    (DRIVE, SCRIPT.replace("\n", "\r\n"), files.check_scripts,
     rf"drive.py has Windows line endings: sed -i 's/\r$//' {{0}}/{DRIVE}"),
    *((DRIVE, f"{first}\n", files.check_scripts,
       f"drive.py begins with {first}, which does not start ROS's Python: write #!/usr/bin/env python3")
      for first in ("#!/usr/bin/env snake", "#!/usr/bin/env python9", "#!usr/bin/env python3", "#!/usr/bin/env",
                    "#!/bin/nothing", "#!/bin/sh", "#!"))])
def test_problem_of_a_file(mine, file, text, check, problem):
    (mine / file).unlink() if text is None else (mine / file).write_bytes(text.encode())
    assert check("mine") == problem.format(mine)


def test_not_built(mine):
    (mine.parents[1] / "devel").rename(mine.parents[1] / "elsewhere")
    assert files.check_built("mine") == "mine is not built: ./morbot setup"


@pytest.mark.parametrize("text", [
    b"<package", b"", b"<launch/>", b'<?xml version="1.0" encoding="foo"?><a/>', b"\xff",
    b"<package><name>mine</name></package>"])
def test_package_xml_describes_no_package(mine, text):
    (mine / "package.xml").write_bytes(text)
    with pytest.raises(InvalidPackage, match=rf"^{re.escape(str(mine))}/package\.xml cannot be read: [^\n]+$"):
        depends("mine")


@pytest.mark.parametrize("line, where", [
    ("while True", r" \(drive\.py, line 3\)"), ("if 1:\nprint()", r" \(drive\.py, line 4\)"), ("\0", "")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / DRIVE).write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"Python cannot read drive\.py: [^\n]+{where}", files.check_scripts("mine"))


def test_script_that_is_no_file(mine):
    (mine / DRIVE).unlink()
    (mine / DRIVE).symlink_to("nowhere")
    assert files.check_scripts("mine") == f"{mine / DRIVE} is not a file: remove it"


@pytest.mark.parametrize("name", [".drive.py", ".#drive.py", "notes.txt"])
def test_hidden_and_other_files_are_no_scripts(mine, name):
    (mine / "scripts" / name).symlink_to("nowhere")
    assert files.check_scripts("mine") is None


@pytest.mark.parametrize("first", ["#!/usr/bin/env python3 ", "#!/usr/bin/python3 -u", "#!/usr/bin/env -S python3 -u"])
def test_first_lines_that_start(mine, first):
    (mine / DRIVE).write_text(f"{first}\nprint()\n")
    assert files.check_scripts("mine") is None


def test_script_is_not_executable(mine):
    (mine / DRIVE).chmod(0o644)
    assert files.check_scripts("mine") == f"drive.py is not executable: chmod +x {mine / DRIVE}"


@pytest.mark.parametrize("make, reason", [
    (os.mkfifo, "not a regular file"), (lambda file: os.truncate(open(file, "w").name, 50 * 10**9), "larger than ")])
@pytest.mark.parametrize("file", ["package.xml", LAUNCH, DRIVE])
def test_what_is_not_a_small_file_is_not_read(mine, file, make, reason):
    (mine / file).unlink()
    make(mine / file)
    try:
        problems = [check("mine") for check in (depends, files.check_launch_files, files.check_scripts)]
    except InvalidPackage as error:
        problems = [str(error)]
    [problem] = filter(None, problems)
    assert problem.startswith((f"{mine / file} cannot be read: {reason}", f"{mine / file} is not a file"))
