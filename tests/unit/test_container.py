"""What the files in docker/ promise: what a service may do, and that the image `run` has every dependency."""

import re
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
