"""Where the camera of a JetBot looks: a pinhole, level from left to right. numpy is imported when it is first used."""

import math
from typing import Any, Tuple

HEIGHT, AHEAD = 0.108, 0.066  # m: the lens above the floor, and ahead of the axle; of gym-duckietown's robot
TILT = 19.0                   # degrees down; of the same
FIELD_OF_VIEW = 75.0          # degrees, from the upper to the lower edge; of a JetBot's lens in a square picture


def focal_length(height: int) -> float:
    """Return the focal length in pixels of a picture of this height."""
    return height / 2 / math.tan(math.radians(FIELD_OF_VIEW / 2))


def rays(width: int, height: int) -> Tuple[Any, Any]:
    """Return where the rays through the middles of the pixels lead: how far down and to the left in 1 m ahead, in m.

    down: height x 1, negative above the horizon; left: height x width. A ray reaches the floor HEIGHT / down ahead.
    """
    import numpy
    focal, tilt = focal_length(height), math.radians(TILT)
    below = numpy.arange(height)[:, None] + 0.5 - height / 2  # the optical axis
    right = numpy.arange(width) + 0.5 - width / 2
    ahead = focal * math.cos(tilt) - below * math.sin(tilt)
    return (focal * math.sin(tilt) + below * math.cos(tilt)) / ahead, -right / ahead
