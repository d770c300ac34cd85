"""A pupil's package for the checks of its files."""

import pytest

from jetbot_lessons import packages

PACKAGE_XML = """<package format="3"><name>mine</name><version>0.0.1</version><description>Mine.</description>
<maintainer email="me@example.com">Me</maintainer><license>MIT</license>
<depend>rospy</depend><depend>geometry_msgs</depend></package>"""
DRIVE, LAUNCH = "scripts/drive.py", "launch/drive.launch"
SCRIPT = "#!/usr/bin/env python3\nprint()\n"
INCLUDE = '<include file="$(find jetbot_control_node)/launch/jetbot_controller.launch" pass_all_args="true"/>'


@pytest.fixture(name="mine")
def made_package(tmp_path, monkeypatch):
    """The folder of a package with nothing missing."""
    return make_package(tmp_path, monkeypatch)


def make_package(tmp_path, monkeypatch):
    """Make a package with nothing missing in this folder, and return its own."""
    monkeypatch.setattr(packages, "__file__", str(tmp_path / "src/jetbot_lessons/src/jetbot_lessons/packages.py"))
    (tmp_path / "src/jetbot_lessons").mkdir(parents=True)
    (tmp_path / "src/jetbot_lessons/package.xml").write_text(PACKAGE_XML.replace("mine", "jetbot_lessons"))
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
