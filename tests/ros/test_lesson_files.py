"""check_lesson.py reports each problem of a pupil's files in one sentence."""

import re

import pytest

from jetbot_lessons import answers, lessons, package_files, packages
from jetbot_lessons.package_files import check_launch_files, check_scripts
from lesson_package import DRIVE, INCLUDE, LAUNCH, PACKAGE_XML, SCRIPT, made_package  # noqa: F401  a fixture


def exists(package):
    return lessons.described(packages.check_exists, package, "make it")


def depends(package):
    return package_files.check_depends(package, "rospy", "geometry_msgs")


def test_nothing_is_missing(mine):
    for check in exists, depends, check_scripts, packages.check_built, check_launch_files:
        assert check("mine") is None


@pytest.mark.parametrize("given, problem", [
    ("yours", "There is no package yours in {}: make it"),
    *((name, "A package's name begins with a letter and has letters, digits and _: type the name of yours")
      for name in ("", "/", "..", "my car", "2cars", "m" * 5000))])
def test_no_package(mine, given, problem):
    assert exists(given) == problem.format(mine.parent)


def test_package_outside_the_workspace(mine, tmp_path, monkeypatch):
    mine.rename(tmp_path / "mine")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{mine.parent}:{tmp_path / 'mine'}")
    assert exists("mine") is None


def test_package_that_setup_has_left_out(mine):
    (mine / "CATKIN_IGNORE").write_text(f"morbot: {mine} is left out: it is broken. Correct it, then: ./morbot setup\n")
    assert exists("mine") == f"{mine} is left out: it is broken. Correct it, then: ./morbot setup"


@pytest.mark.parametrize("file, text, check, problem", [
    ("CMakeLists.txt", None, exists, "{0} has no CMakeLists.txt: mv {0} ~, "),
    ("package.xml", PACKAGE_XML.replace("<depend>geometry_msgs</depend>", ""), depends,
     "add <exec_depend>geometry_msgs</exec_depend>"),
    (LAUNCH, None, check_launch_files, "no launch file in {0}/launch"),
    (LAUNCH, "<launch/>", check_launch_files, f"{{0}}/{LAUNCH} does not include the controller: add {INCLUDE} "),
    (LAUNCH, f"<launch>{INCLUDE.replace('true', 'false')}</launch>", check_launch_files, 'pass_all_args="true"'),
    (LAUNCH, "<launch>", check_launch_files, f"{{0}}/{LAUNCH} is not XML: no element found: line 1, column 8"),
    (DRIVE, None, check_scripts, "no script in {0}/scripts"),
    (DRIVE, "print()\n", check_scripts, "drive.py does not begin with #!/usr/bin/env python3"),
    (DRIVE, " \n", check_scripts, f"{{0}}/{DRIVE} is empty"),
    (DRIVE, "#!/usr/bin/env python3\n# Drives.\n", check_scripts, "drive.py holds no command yet"),
    (DRIVE, SCRIPT.replace("\n", "\r\n"), check_scripts, rf"line endings: sed -i 's/\r$//' {{0}}/{DRIVE}"),
    *((DRIVE, f"{first}\n", check_scripts, f"drive.py begins with {first}, which does not start ROS's Python")
      for first in ("#!/usr/bin/env python9", "#!usr/bin/env python3", "#!/bin/sh", "#!"))])
def test_problem_of_a_file(mine, file, text, check, problem):
    (mine / file).unlink() if text is None else (mine / file).write_bytes(text.encode())
    assert problem.format(mine) in check("mine")


def test_not_built(mine):
    (mine.parents[1] / "devel").rename(mine.parents[1] / "elsewhere")
    assert packages.check_built("mine") == "mine is not built: ./morbot setup"


@pytest.mark.parametrize("text", [b"<package", b"<launch/>", b"<package><name>mine</name></package>"])
@pytest.mark.parametrize("wanted", ["mine", "jetbot_lessons"])
def test_package_xml_describes_no_package(mine, text, wanted):
    (mine / "package.xml").write_bytes(text)
    problem = exists(wanted)
    assert problem.startswith(f"{mine}/package.xml cannot be read: ") and problem.isprintable()
    assert problem.endswith(": correct that, then ./morbot setup")


@pytest.mark.parametrize("line, where", [
    ("while True", r" \(drive\.py, line 3\)"), ("if 1:\nprint()", r" \(drive\.py, line 4\)"), ("\0", "")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / DRIVE).write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"Python cannot read drive\.py: [^\n]+{where}", check_scripts("mine"))


def test_script_that_is_no_file(mine):
    (mine / "scripts/.#drive.py").symlink_to("nowhere")  # of an editor: no script
    assert check_scripts("mine") is None
    script = mine / "scripts/a.py"
    script.symlink_to("nowhere")
    assert check_scripts("mine") == f"{script} is not a file: mv {script} ~"


@pytest.mark.parametrize("first", ["#!/usr/bin/env python3 ", "#!/usr/bin/python3 -u", "#!/usr/bin/env -S python3 -u"])
def test_first_lines_that_start(mine, first):
    (mine / DRIVE).write_text(f"{first}\nprint()\n")
    assert check_scripts("mine") is None


def test_script_is_not_executable_in_a_folder_with_a_space(mine):
    folder = mine.rename(mine.with_name("my car"))
    (folder / DRIVE).chmod(0o644)
    assert check_scripts("mine") == f"drive.py is not executable: chmod +x '{folder / DRIVE}'"


@pytest.mark.parametrize("text, problem", [
    ("rospy geometry_msgs", None), ("geometry_msgs,\r\nrospy\r\n", None),
    ("rospy", "{0} names 1 of the 2 packages that mine needs when it runs: add each exec_depend of {1}"),
    ("", "{0} is empty: write into it which packages mine needs when it runs, one per line, and save it"),
    ("<depend>rospy</depend>", "{0} has lines of package.xml: write the names alone, without <exec_depend>"),
    ("rospi geometry_msgs", "{0} names rospi, and {1} does not: correct or remove it"),
    ("catkin", "mine needs catkin to be built, not when it runs: remove catkin from {0}"),
    ("roslaunch", "mine needs roslaunch to be tested, not when it runs: remove roslaunch from {0}")])
def test_answer_of_lesson_1(mine, monkeypatch, text, problem):
    monkeypatch.chdir(mine)
    manifest, answer = mine / "package.xml", mine / "lesson_1.txt"
    manifest.write_text(PACKAGE_XML.replace("</package>", "<buildtool_depend>catkin</buildtool_depend>"
                                                          "<test_depend>roslaunch</test_depend></package>"))
    answer.write_text(text)
    assert answers.check_needed("mine") == (problem and problem.format(answer, manifest))


def test_answer_of_lesson_1_is_missing_or_lies_in_the_projects_folder(mine, monkeypatch):
    monkeypatch.chdir(mine)
    assert answers.check_needed("mine").startswith(f"There is no file lesson_1.txt in {mine}: make it, and write ")
    monkeypatch.setattr(answers, "workspace", lambda: mine.parent / "morbot_ws/src")
    (mine.parent / "lesson_1.txt").write_text("rospy geometry_msgs")
    assert answers.check_needed("mine") is None
