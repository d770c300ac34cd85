"""A package that breaks breaks no other: built for real, in a copy of the project."""

import os
import re
import shutil
import subprocess

from pupil import NOT_COPIED, ROOT, WORKSPACE
from pupil_terminal import PS1, Terminal

BROKEN_XML = "<package>\n<name>mine</name>\n"
USE = """set -e
rospack find workshop
roslaunch --files simulation simulation.launch
rosrun jetbot_tools doctor.py --help >/dev/null
rosrun jetbot_lessons check_lesson.py 1 || exit 0  # it may name the copy"""


def test_all_other_packages_are_built_and_work_also_in_an_open_shell(tmp_path):
    project = tmp_path / "MorBot"
    shutil.copytree(ROOT, project, symlinks=True, ignore=shutil.ignore_patterns(*NOT_COPIED))
    scenarios = project / "morbot_ws/src/scenarios"
    add_broken_packages(scenarios)
    code, messages = morbot(project, "setup")
    assert code == 1
    assert f"{scenarios}/xml/package.xml, line 1: <package> has no end: add </package>." in messages
    assert f"{scenarios}/copy/package.xml has the same <name> as {scenarios}/workshop: " in messages
    assert re.search(rf"{scenarios}/cmake/CMakeLists.txt, line \d+: write project\(cmake\)", messages)
    assert messages.endswith("morbot: everything else is ready\n")

    code, messages = morbot(project, "shell", "sh", "-c", USE)
    assert code == 0, messages
    assert f"\n{scenarios}/workshop\n" in messages and messages.splitlines()[-1].startswith("Lesson 1: ")
    assert "xml/package.xml, line 1" in messages and "morbot: building" not in messages
    break_a_package_while_a_shell_is_open(project)


def add_broken_packages(scenarios):
    """A copy of the workshop's package, one whose CMakeLists.txt has another name, and one that is not XML."""
    for name in "copy", "cmake", "xml":
        shutil.copytree(scenarios / "workshop", scenarios / name)
    (scenarios / "xml/package.xml").write_text(BROKEN_XML)
    file = scenarios / "cmake/package.xml"
    file.write_text(file.read_text().replace("workshop</name>", "cmake</name>"))


def morbot(project, *arguments):
    """Run ./morbot as in a new terminal, and return its exit code and all that it printed."""
    process = subprocess.run([str(project / "morbot"), *arguments], env=environment(project), stdout=subprocess.PIPE,
                             stderr=subprocess.STDOUT, encoding="utf-8")
    return process.returncode, process.stdout


def environment(project):
    clean = {name: value for name, value in os.environ.items() if not name.startswith(WORKSPACE)}
    return {**clean, "HOME": str(project.parent), "TERM": "dumb"}


def break_a_package_while_a_shell_is_open(project):
    (project.parent / ".bashrc").write_text(f"PS1='{PS1}'\nbind 'set enable-bracketed-paste off'\n")
    terminal = Terminal(project, environment(project))
    try:
        terminal.type("./morbot shell")
        assert terminal.wait_for_end() == 0
        mine = project / "morbot_ws/src/mine"
        mine.mkdir()
        (mine / "package.xml").write_text(BROKEN_XML)
        terminal.new_box()
        terminal.type("rosrun jetbot_lessons check_lesson.py 1")
        terminal.wait_for_end()
        assert f"{mine}/package.xml, line 1: <package> has no end" in terminal.output
        assert "\nLesson 1: " in terminal.output and "Exception" not in terminal.output
    finally:
        terminal.close()
