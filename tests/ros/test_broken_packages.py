"""A package that breaks breaks no other: built for real, in a copy of the project."""

import os
import shutil
import subprocess

from pupil import NOT_COPIED, ROOT, WORKSPACE

NOT_NEEDED = ("jetbot_class", "jetbot_cockpit", "jetbot_lessons", "simulation", "driving_tasks")  # CMake's time


def test_all_other_packages_are_built_and_work(tmp_path):
    project = tmp_path / "MorBot"
    shutil.copytree(ROOT, project, symlinks=True, ignore=shutil.ignore_patterns(*NOT_COPIED, *NOT_NEEDED))
    scenarios = project / "morbot_ws/src/scenarios"
    for name in "copy", "cmake", "xml":
        shutil.copytree(scenarios / "workshop", scenarios / name)
    (scenarios / "xml/package.xml").write_text("<package>\n<name>mine</name>\n")
    file = scenarios / "cmake/package.xml"
    file.write_text(file.read_text().replace("workshop</name>", "cmake</name>"))  # CMakeLists.txt has the other name
    code, messages = morbot(project, "setup")
    assert code == 1 and messages.endswith("morbot: everything else is ready\n"), messages
    for name in "copy", "cmake", "xml":
        assert f"morbot: {scenarios}/{name} is left out: " in messages

    code, messages = morbot(project, "shell", "sh", "-c", "rospack find workshop; rosrun jetbot_tools doctor.py --help")
    assert code == 0 and f"\n{scenarios}/workshop\n" in messages, messages
    assert "xml is left out" in messages and "morbot: building" not in messages


def morbot(project, *arguments):
    """Run ./morbot as in a new terminal, and return its exit code and all that it printed."""
    clean = {name: value for name, value in os.environ.items() if not name.startswith(WORKSPACE)}
    process = subprocess.run([project / "morbot", *arguments], env={**clean, "HOME": str(project.parent)},
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, encoding="utf-8")
    return process.returncode, process.stdout
