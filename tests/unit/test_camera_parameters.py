"""The camera's parameters: what cannot be is refused."""

import pytest

from jetbot import InvalidValue
from jetbot_camera.camera_parameters import PARAMETERS
from jetbot_ros.node_parameters import check_values


@pytest.mark.parametrize("given", [
    {"width": 0}, {"height": 5000}, {"fps": 0.5}, {"fps": True}, {"quality": 96}, {"flip": "yes"}, {"source": 3},
    {"brightness": 1}], ids=str)
def test_what_cannot_be_is_refused(given):
    with pytest.raises(InvalidValue):
        check_values(given, PARAMETERS)
