"""check_lesson.py reports each problem of a pupil's files in one sentence."""

import os
import re
import time

import pytest

from jetbot_lessons import answers, files, limited, marking, packages

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
    monkeypatch.setattr(packages, "__file__", str(tmp_path / "src/jetbot_lessons/src/jetbot_lessons/packages.py"))
    (tmp_path / "src/jetbot_lessons").mkdir(parents=True)
    (tmp_path / "src/jetbot_lessons/package.xml").write_text(PACKAGE_XML.replace("mine", "jetbot_lessons"))
    monkeypatch.setenv("ROS_PACKAGE_PATH", str(tmp_path / "src/jetbot_lessons"))  # a list, while another is broken
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


@pytest.mark.parametrize("given, problem", [
    ("yours", "There is no package yours in {}: make it"),
    *((name, f"There is no package {name}, but there is mine: type that name, or make it")
      for name in ("Mine", "scenarios/mine", "/mine/", "mien")),
    *((name, "A package's name begins with a letter and has letters, digits and _: type the name of yours")
      for name in ("", "/", "..", "my car", "2cars", "m" * 5000))])
def test_no_package(mine, given, problem):
    assert exists(given) == problem.format(mine.parent)


def test_package_outside_the_workspace(mine, tmp_path, monkeypatch):
    mine.rename(tmp_path / "mine")
    monkeypatch.setenv("ROS_PACKAGE_PATH", f"{mine.parent}:{tmp_path / 'mine'}")
    assert exists("mine") is None


@pytest.mark.parametrize("place, name", [("mine", "CATKIN_IGNORE"), (".", "CATKIN_IGNORE"), ("mine", "COLCON_IGNORE")])
def test_package_that_catkin_ignores(mine, place, name):
    marker = mine.parent / place / name
    marker.touch()
    assert exists("mine") == f"ROS and catkin ignore {mine}: rm {marker}, then ./morbot setup"


def test_copied_package(mine):
    copy = mine.with_name("a copy")
    copy.mkdir()
    (copy / "package.xml").write_text(PACKAGE_XML)
    assert exists("mine").startswith(f"{copy}/package.xml has the same <name> as {mine}: write ")


def test_a_link_that_leads_back_is_named_and_not_followed_forever(mine):
    for name in "one", "two":
        (mine.parent / name).symlink_to(mine.parent)
    link = mine.parent / "one"
    assert exists("mine") == f"{link} leads to a folder that ROS searches already: rm {link}"


def test_package_of_ros_is_not_the_pupils(mine, monkeypatch):
    assert files.check_own("mine") is None
    monkeypatch.setattr(files, "folder", lambda name: packages.Path("/usr/share/rospy"))
    assert files.check_own("rospy") == "rospy comes with ROS, in /usr/share/rospy: type the name of your own package"


def test_package_where_ros_does_not_search(mine):
    elsewhere = mine.rename(mine.parents[1] / "mine")
    assert exists("mine") == f"ROS does not search {elsewhere.parent} for packages: mv {elsewhere} {mine.parent}"


def test_package_xml_that_hides_the_package(mine):
    (mine.parent / "package.xml").write_text(PACKAGE_XML.replace("mine", "other"))
    assert exists("mine").startswith(f"{mine.parent}/package.xml hides the packages in its folder from ROS: mv ")


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
      for text in ("print()\n", "\n#!")),
    *((DRIVE, text, files.check_scripts, f"{{0}}/{DRIVE} is empty: write your program into it, and save it")
      for text in ("", " \n")),
    *((DRIVE, text, files.check_scripts, "drive.py holds no command yet: write your program into it, and save it")
      for text in ("#!/usr/bin/env python3", "#!/usr/bin/env python3\n# Drives.\n")),
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
@pytest.mark.parametrize("wanted", ["mine", "jetbot_lessons"])
def test_package_xml_describes_no_package(mine, text, wanted):
    (mine / "package.xml").write_bytes(text)
    problem = exists(wanted)
    assert problem.startswith(f"{mine}/package.xml") and problem.isprintable()
    assert problem.endswith(". Until then, the package is used as it was last built, or left out.")


@pytest.mark.parametrize("line, where", [
    ("while True", r" \(drive\.py, line 3\)"), ("if 1:\nprint()", r" \(drive\.py, line 4\)"), ("\0", "")])
def test_script_that_python_cannot_read(mine, line, where):
    (mine / DRIVE).write_text(f"{SCRIPT}{line}\n")
    assert re.fullmatch(rf"Python cannot read drive\.py: [^\n]+{where}", files.check_scripts("mine"))


def test_script_that_is_no_file(mine):
    script = mine / DRIVE
    script.unlink()
    script.symlink_to("nowhere")
    assert files.check_scripts("mine") == f"{script} is a link to nowhere, which does not exist: rm {script}"
    script.unlink()
    script.mkdir()
    assert files.check_scripts("mine") == f"{script} is not a file: mv {script} ~"


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


def test_advice_works_where_a_folder_has_a_space(mine):
    folder = mine.rename(mine.with_name("my car"))
    (folder / DRIVE).chmod(0o644)
    assert files.check_scripts("mine") == f"drive.py is not executable: chmod +x '{folder / DRIVE}'"


@pytest.mark.parametrize("make, reasons", [
    (os.mkfifo, (" is not a regular file", " cannot be read: not a regular file", " is not a file")),
    (lambda file: os.truncate(open(file, "w").name, 50 * 10**9), (" is too large", " cannot be read: larger than "))])
@pytest.mark.parametrize("file", ["package.xml", LAUNCH, DRIVE])
def test_what_is_not_a_small_file_is_not_read(mine, file, make, reasons):
    (mine / file).unlink()
    make(mine / file)
    problem = exists("mine") or files.check_launch_files("mine") or files.check_scripts("mine")
    assert problem.startswith(tuple(f"{mine / file}{reason}" for reason in reasons))


@pytest.mark.parametrize("text, problem", [
    ("rospy geometry_msgs", None), ("geometry_msgs,\r\nrospy\r\n", None),
    ("rospy", "{0} names 1 of the 2 packages that mine needs when it runs: add each exec_depend of {1}"),
    ("", "{0} is empty: write into it which packages mine needs when it runs, one per line, and save it"),
    ("<depend>rospy</depend>", "{0} has lines of package.xml: write the names alone, without <exec_depend>"),
    ("rospi geometry_msgs", "{0} names rospi, and {1} does not: do you mean rospy?"),
    ("rospy simulation", "{0} names simulation, and {1} does not: remove it"),
    ("mine", "{0} names mine itself: write only the packages that it needs"),
    ("catkin", "mine needs catkin to be built, not when it runs: remove catkin from {0}"),
    ("roslaunch", "mine needs roslaunch to be tested, not when it runs: remove roslaunch from {0}")])
def test_answer_of_lesson_1(mine, monkeypatch, text, problem):
    monkeypatch.chdir(mine)
    manifest, answer = mine / "package.xml", mine / "lesson_1.txt"
    manifest.write_text(PACKAGE_XML.replace("</package>", "<buildtool_depend>catkin</buildtool_depend>"
                                                          "<test_depend>roslaunch</test_depend></package>"))
    answer.write_text(text)
    assert answers.check_needed("mine") == (problem and problem.format(answer, manifest))


def test_answer_of_lesson_1_is_missing_has_another_name_or_lies_in_the_projects_folder(mine, monkeypatch):
    monkeypatch.chdir(mine)
    assert answers.check_needed("mine").startswith(f"There is no file lesson_1.txt in {mine}: make it, and write ")
    (mine / "Lesson1.txt").touch()
    assert answers.check_needed("mine") == (f"{mine}/Lesson1.txt has another name: "
                                            f"mv {mine}/Lesson1.txt {mine}/lesson_1.txt")
    monkeypatch.setattr(answers, "workspace", lambda: mine.parent / "morbot_ws/src")
    (mine.parent / "lesson_1.txt").write_text("rospy geometry_msgs")
    assert answers.check_needed("mine") is None


def mark(lesson, folder):
    """Return the problem in the row of a folder, without its path."""
    [row] = marking.mark_folders(lesson, [str(folder)])
    assert row.name.isprintable() and row.problem.isprintable() and row.done == ("no" if row.problem else "yes")
    return row.problem.replace(f"{folder}/", "")


def test_package_that_was_handed_in(mine, tmp_path):
    assert mark(7, mine.parent).endswith("has 2 packages: give the folder of one")
    (tmp_path / "ann").mkdir()
    package = mine.rename(tmp_path / "ann/mine")
    assert (mark(7, package), mark(7, package.parent)) == ("", "")
    assert mark(8, package) == ("package.xml does not name jetbot_control_node: "
                                "add <exec_depend>jetbot_control_node</exec_depend> before </package>")
    assert mark(9, package) == ("There is no file metre.bag: record your drive with "
                                "rosrun driving_tasks judge.py metre --record metre.bag")


ENTITIES = "".join(f'<!ENTITY l{n} "{10 * f"&l{n - 1};"}">' for n in range(1, 12))
BOMB = f'<!DOCTYPE l [<!ENTITY l0 "lol">{ENTITIES}]><launch>&l11;</launch>'


@pytest.mark.parametrize("file, content, problem", [
    (DRIVE, SCRIPT + "-" * 900_000 + "1", "Python cannot read drive.py: it is nested too deeply"),
    (DRIVE, SCRIPT + "a" + ".b" * 400_000, "Python cannot read drive.py: "),
    (DRIVE, SCRIPT + "open('executed', 'w')", ""),
    ("package.xml", BOMB, "package.xml cannot be read: it defines the entity l0: remove <!ENTITY ...>"),
    ("package.xml", PACKAGE_XML.replace("Mine.", "<b>" * 7000 + "</b>" * 7000), "package.xml cannot be read: "),
    (DRIVE, os.mkfifo, "scripts/drive.py is not a file"),
    (DRIVE, lambda file: file.symlink_to("/etc/passwd"), "scripts/drive.py is a link that leads out of the package"),
    ("package.xml", lambda file: file.symlink_to("/dev/zero"), "package.xml is a link that leads out of the package"),
    ("\033[2J\n", lambda folder: folder.symlink_to("/"), r"\x1b[2J\n is a link that leads out of the package"),
    ("CMakeLists.txt", lambda file: None, "There is no CMakeLists.txt in "),
    ("many", lambda folder: [(folder / str(n)).mkdir(parents=True) for n in range(1000)],
     "mine has more than 1,000 files")])
def test_hostile_folder_gets_a_row_and_is_not_executed(mine, monkeypatch, file, content, problem):
    monkeypatch.chdir(mine)
    place = mine / file
    if place.exists():
        place.unlink()
    content(place) if callable(content) else place.write_text(content)
    if (mine / DRIVE).exists():
        (mine / DRIVE).chmod(0o755)
    found = mark(7, mine).replace(f"{mine.parent}/", "")
    assert found[:len(problem)] == problem and not (mine / "executed").exists()
    assert problem or not found


@pytest.mark.parametrize("happens, reason", [
    (os.abort, "It needs more than "), (lambda: time.sleep(60), "It takes more than 1 s.")])
def test_file_that_ends_or_stops_its_reader_gets_a_row(mine, monkeypatch, happens, reason):
    monkeypatch.setattr(limited, "LIMITS", limited.LIMITS._replace(wall_time=1))
    monkeypatch.setattr(files, "check_scripts", lambda package: happens())
    assert f" cannot be checked: {reason}" in mark(7, mine)


def test_launch_file_that_is_an_xml_bomb(mine):
    (mine / LAUNCH).write_text(BOMB)
    assert files.check_launch_files("mine") == f"{mine / LAUNCH} is not XML: it defines the entity l0: " \
                                               "remove <!ENTITY ...>"


def test_package_xml_bomb_in_the_workspace(mine):
    (mine / "package.xml").write_text(BOMB)
    assert exists("jetbot_lessons").startswith(f"{mine}/package.xml, line 1: it defines the entity l0: ")
