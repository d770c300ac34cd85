"""All packages have one version, and each installs all of its modules."""

import re
import runpy
import sys
import xml.etree.ElementTree as ET
from types import SimpleNamespace

import pytest

import jetbot
from conftest import PACKAGES, ROOT

MANIFESTS = sorted([*PACKAGES.glob("*/package.xml"), *PACKAGES.glob("scenarios/*/package.xml"),
                    ROOT / "bench/package.xml", ROOT / "tests/ros/package.xml"])
SETUPS = sorted(PACKAGES.glob("*/setup.py"))
ROSDEP_KEYS = set(  # rosdistro of August 2026 has them for Debian 12 and 13, and for noetic on Ubuntu 20.04
    "catkin diagnostic_msgs diagnostic_updater genpy geometry_msgs nav_msgs python3-catkin-pkg python3-matplotlib "
    "python3-numpy python3-pil python3-segno python3-serial python3-setuptools python3-smbus2 python3-smbus2-pip "
    "python3-tornado python3-yaml robot_state_publisher rosbag rosgraph roslaunch roslib rospy rostest rostopic "
    "sensor_msgs std_msgs std_srvs tf2_msgs tf2_ros visualization_msgs".split())


@pytest.fixture
def setup_of(monkeypatch):
    """Return what a setup.py gives to setuptools."""
    given = {}
    monkeypatch.setitem(sys.modules, "setuptools", SimpleNamespace(setup=given.update))
    monkeypatch.setitem(sys.modules, "catkin_pkg", SimpleNamespace())
    monkeypatch.setitem(sys.modules, "catkin_pkg.python_setup",
                        SimpleNamespace(generate_distutils_setup=lambda **fields: fields))
    return lambda file: runpy.run_path(str(file)) and given


@pytest.mark.parametrize("file", SETUPS, ids=lambda file: file.parent.name)
def test_a_setup_names_each_folder_with_modules(file, setup_of):
    source = file.parent / "src"
    folders = {module.parent.relative_to(source).as_posix().replace("/", ".") for module in source.rglob("*.py")}
    assert set(setup_of(file)["packages"]) == folders


def test_all_packages_have_one_version(setup_of):
    versions = {file: ET.parse(file).getroot().findtext("version") for file in MANIFESTS}
    assert set(versions.values()) == {jetbot.__version__}, versions
    assert setup_of(PACKAGES / "jetbot/setup.py")["version"] == jetbot.__version__


@pytest.mark.parametrize("file", sorted(PACKAGES.glob("**/CHANGELOG.rst")), ids=lambda file: file.parent.name)
def test_a_changelog_begins_with_this_version(file):
    assert re.search(r"^(\d+\.\d+\.\d+) \(\d{4}-\d\d-\d\d\)$", file.read_text(), re.M)[1] == jetbot.__version__


def test_rosdep_knows_every_dependency():
    roots = [ET.parse(file).getroot() for file in MANIFESTS]
    keys = {each.text for root in roots for each in root if each.tag.endswith("depend")}
    assert keys - {root.findtext("name") for root in roots} == ROSDEP_KEYS


def test_what_a_missing_extra_keeps_away_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", None)
    monkeypatch.delitem(sys.modules, "jetbot.heartbeat", raising=False)
    with pytest.raises(ImportError, match=r"needs ipywidgets: pip install 'jetbot\[notebook\]'"):
        jetbot.Heartbeat  # noqa: B018
