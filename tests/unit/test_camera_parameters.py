"""The camera's parameters: a row each, in the launch file and in the reference; what cannot be is refused."""

import re

import pytest
from test_docs import rows

from conftest import PACKAGES, ROOT
from jetbot import InvalidValue
from jetbot_camera.camera_parameters import PARAMETERS
from jetbot_ros.node_parameters import check_values

LAUNCH = PACKAGES / "jetbot_camera/launch/camera.launch"


@pytest.mark.parametrize("name", PARAMETERS)
def test_a_parameter_is_in_the_launch_file_and_in_the_reference(name):
    row = PARAMETERS[name]
    default = str(row.default).lower()
    shown = " ".join(filter(None, (default or "JETBOT_CAMERA, or csi", row.unit)))
    assert f'<arg name="{name}" default="" doc="{row.doc} ({shown})"/>' in LAUNCH.read_text()
    cells = [f"`{name}:=`", f"`{default}`" if default else "`csi`, or JETBOT_CAMERA", row.unit, row.doc]
    assert cells in rows((ROOT / "docs/reference.md").read_text())


def test_the_launch_file_passes_on_all_parameters():
    assert re.findall(r'<param name="(\w+)" value="\$\(arg (\w+)\)"/>', LAUNCH.read_text()) == [
        (name, name) for name in PARAMETERS]


@pytest.mark.parametrize("given", [
    {"width": 0}, {"height": 5000}, {"fps": 0.5}, {"fps": True}, {"quality": 96}, {"flip": "yes"}, {"source": 3},
    {"brightness": 1}], ids=str)
def test_what_cannot_be_is_refused(given):
    with pytest.raises(InvalidValue):
        check_values(given, PARAMETERS)
