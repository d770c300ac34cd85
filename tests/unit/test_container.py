"""What the files in docker/ promise: what a service may do, and that the image `run` has every dependency."""

import re
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
    assert name == "robot" or "devices" not in service


@pytest.mark.parametrize("name", SERVICES)
def test_service_listens_on_the_loopback_interface_by_default(name):
    hostname = SERVICES[name].get("environment", {}).get("ROS_HOSTNAME")
    assert SERVICES[name]["network_mode"] == "none" or hostname == "${JETBOT_HOSTNAME:-localhost}"


def test_image_has_all_that_the_nodes_need():
    assert {debian_name(depend) for package in PACKAGES for depend in package.iterfind("exec_depend")
            if depend.text not in OURS and "==" not in depend.get("condition", "")} - NOT_IN_THE_IMAGE <= installed()


def installed():
    """Return the packages that ./morbot installs in the image `run`."""
    return set(re.search(r'^run_packages="(.*?)"', (ROOT / "morbot").read_text(), re.M | re.S)[1].split())


def debian_name(depend):
    """Return Debian's name of a dependency in a package.xml; a package in C++ begins with ros-."""
    name = depend.text.replace("_", "-")
    return f"ros-{name}" if name == "robot-state-publisher" else re.sub("^(python3-)?", "python3-", name)
