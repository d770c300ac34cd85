"""What the files in docker/ promise: what a service may do, and that the image `run` has every dependency."""

import re
from pathlib import Path
from xml.etree import ElementTree

import pytest
import yaml

from conftest import ROOT
from jetbot.camera.sources import SOURCES

SERVICES = yaml.safe_load((ROOT / "docker/compose.yaml").read_text())["services"]
PACKAGES = [ElementTree.parse(file) for file in (ROOT / "morbot_ws/src").rglob("package.xml")]
OURS = {package.findtext("name") for package in PACKAGES}
NOT_IN_THE_IMAGE = {"python3-matplotlib"}  # it draws pictures, and is as large as all of ROS


@pytest.mark.parametrize("name", SERVICES)
def test_service_has_no_privileges(name):
    service = SERVICES[name]
    assert service["cap_drop"] == ["ALL"] and service["security_opt"] == ["no-new-privileges:true"]
    assert not {"privileged", "cap_add", "pid", "ipc", "ports", "user"} & set(service)
    assert name in ("test", "jetson_camera") or service["read_only"]
    assert name in ("robot", "guard", "camera") or not service.get("devices")


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


def test_a_camera_is_a_service_of_its_own_that_uses_nothing_but_its_device():
    camera, jetson = SERVICES["camera"], SERVICES["jetson_camera"]
    assert camera["devices"] == [camera["environment"]["JETBOT_CAMERA"]] == ["${JETBOT_CAMERA:-/dev/video0}"]
    assert camera["group_add"] == ["${VIDEO_GID:-video}"] and "volumes" not in camera
    assert jetson["runtime"] == "nvidia" and jetson["environment"]["NVIDIA_DRIVER_CAPABILITIES"] == "all"
    assert jetson["volumes"] == ["/tmp/argus_socket:/tmp/argus_socket"] and not jetson["devices"]
    assert jetson["environment"]["JETBOT_CAMERA"] == "csi"


@pytest.mark.parametrize("source", ["usb", "csi"])
def test_images_have_the_programs_of_the_cameras(source):
    missing = SOURCES[source][-1]
    assert set(missing.package.split()) <= packages_named("camera_packages")
    dockerfile = (ROOT / "docker/Dockerfile").read_text()
    assert "morbot install image &&" in dockerfile and "morbot install image-to-run &&" in dockerfile


def test_image_has_all_that_the_nodes_need():
    assert {debian_name(depend) for package in PACKAGES for depend in package.iterfind("exec_depend")
            if depend.text not in OURS and "==" not in depend.get("condition", "")
            } - NOT_IN_THE_IMAGE <= packages_named("run_packages")


def packages_named(name):
    """Return the packages of a list in setup/install.sh; both images have camera_packages, too."""
    return set(re.search(f'^{name}="(.*?)"', (ROOT / "setup/install.sh").read_text(), re.M | re.S)[1].split())


def debian_name(depend):
    """Return Debian's name of a dependency in a package.xml; a package in C++ begins with ros-."""
    name = depend.text.replace("_", "-")
    return f"ros-{name}" if name == "robot-state-publisher" else re.sub("^(python3-)?", "python3-", name)
