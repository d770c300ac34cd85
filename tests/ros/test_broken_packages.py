"""A package that breaks breaks no other: built for real, in a copy of the project."""

import shutil

from project_copy import copy_project, morbot

NOT_NEEDED = ("jetbot_class", "jetbot_cockpit", "jetbot_lessons", "simulation", "driving_tasks",
              "jetbot_camera")  # CMake's time


def test_all_other_packages_are_built_and_work(tmp_path):
    project = copy_project(tmp_path, *NOT_NEEDED)
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
