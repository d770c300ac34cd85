"""sensor_msgs, as its .msg files say: what is not measured here is not here."""

import std_msgs.msg  # noqa: F401
from _start import lacking
from genpy import define

__getattr__ = lacking("sensor_msgs.msg")
define("sensor_msgs", globals(), """
Range Header header, uint8 radiation_type, float32 field_of_view, float32 min_range, float32 max_range, float32 range
""")
Range.ULTRASOUND, Range.INFRARED = 0, 1  # noqa: F821
