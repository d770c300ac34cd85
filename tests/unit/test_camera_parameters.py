"""The camera's parameters: the launch file passes them on; what cannot be is refused."""

import re

import pytest

from conftest import PACKAGES
from jetbot import InvalidValue
from jetbot_camera.camera_parameters import PARAMETERS
from jetbot_ros.node_parameters import check_values

LAUNCH = PACKAGES / "jetbot_camera/launch/camera.launch"


def test_the_launch_file_passes_on_all_parameters():
    assert re.findall(r'<param name="(\w+)" value="\$\(arg (\w+)\)"/>', LAUNCH.read_text()) == [
        (name, name) for name in PARAMETERS]


@pytest.mark.parametrize("given", [
    {"width": 0}, {"height": 5000}, {"fps": 0.5}, {"fps": True}, {"quality": 96}, {"flip": "yes"}, {"source": 3},
    {"brightness": 1}], ids=str)
def test_what_cannot_be_is_refused(given):
    with pytest.raises(InvalidValue):
        check_values(given, PARAMETERS)
