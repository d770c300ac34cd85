"""What the files in docker/ promise: what a service may do, and that the image `run` has every dependency."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from conftest import ROOT

SERVICES = yaml.safe_load((ROOT / "docker/compose.yaml").read_text())["services"]
PACKAGES = [ElementTree.parse(file) for file in (ROOT / "morbot_ws/src").rglob("package.xml")]
OURS = {package.findtext("name") for package in PACKAGES}
NOT_IN_THE_IMAGE = {"python3-matplotlib"}  # it draws pictures, and is as large as all of ROS


@pytest.mark.parametrize("name", SERVICES)
def test_service_has_no_privileges(name):
    service = SERVICES[name]
    assert service["cap_drop"] == ["ALL"] and service["security_opt"] == ["no-new-privileges:true"]
    assert not {"privileged", "cap_add", "pid", "ipc", "ports", "user"} & set(service)
    assert name == "test" or service["read_only"]
    assert name in ("robot", "guard") or "devices" not in service


@pytest.mark.parametrize("name", SERVICES)
def test_service_listens_on_the_loopback_interface_by_default(name):
    hostname = SERVICES[name].get("environment", {}).get("ROS_HOSTNAME")
    assert SERVICES[name]["network_mode"] == "none" or hostname == "${JETBOT_HOSTNAME:-localhost}"


def test_the_cockpit_waits_for_the_robots_master_and_lets_others_in_only_where_asked():
    cockpit = SERVICES["cockpit"]
    assert cockpit["command"][-1] == "exec roslaunch --wait jetbot_cockpit cockpit.launch $$COCKPIT_ARGUMENTS"
    assert cockpit["environment"]["COCKPIT_ARGUMENTS"] == "${COCKPIT_ARGUMENTS:-}" and "volumes" not in cockpit
    assert all(cockpit["environment"][name] == SERVICES["robot"]["environment"][name]
               for name in ("ROS_HOSTNAME", "ROS_MASTER_URI"))


def test_the_guard_of_the_robot_is_a_container_of_its_own_that_starts_first():
    robot, guard = SERVICES["robot"], SERVICES["guard"]
    socket = robot["environment"]["JETBOT_GUARD"]
    assert robot["depends_on"] == ["guard"] and guard["network_mode"] == "none"
    assert guard["command"] == f"python3 -m jetbot.guard --listen {socket}"
    assert all(robot[key] == guard[key] for key in ("devices", "group_add", "restart"))
    assert f"guard:{Path(socket).parent}" in {*robot["volumes"]} & {*guard["volumes"]}
    assert str(Path(socket).parent) in (ROOT / "docker/Dockerfile").read_text()  # there, it belongs to the image's user


def test_image_has_all_that_the_nodes_need():
    assert {debian_name(depend) for package in PACKAGES for depend in package.iterfind("exec_depend")
            if depend.text not in OURS and "==" not in depend.get("condition", "")} - NOT_IN_THE_IMAGE <= installed()


def installed():
    """Return the packages that ./morbot installs in the image `run`."""
    return set(re.search(r'^run_packages="(.*?)"', (ROOT / "setup/install.sh").read_text(), re.M | re.S)[1].split())


def debian_name(depend):
    """Return Debian's name of a dependency in a package.xml; a package in C++ begins with ros-."""
    name = depend.text.replace("_", "-")
    return f"ros-{name}" if name == "robot-state-publisher" else re.sub("^(python3-)?", "python3-", name)
