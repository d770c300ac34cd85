"""Checks of what a pupil's node sees with the robot's camera."""

import io
from typing import Optional

import rospy
from sensor_msgs.msg import CompressedImage
from std_msgs.msg import Float32

from jetbot.wait import wait_until

from . import Problem, graph
from .motion import init_node

PICTURES, ANSWERS = "/camera/image_raw/compressed", "/dark_x"
DARK = 100             # of 255; what is darker is a line
TIMEOUT = 5.0          # s for a picture, and for the node's answer
TOLERANCE = 0.05       # of half the picture's width
MIN_X = 0.1            # nearer to the middle, a node that publishes 0 would be right
SILENT = (f"Nothing arrives on {ANSWERS}: call publish in the function that gets the picture; if you do, "
          "its terminal shows why")
PUT = "put the robot beside a line, as in the lesson"


def check_answer() -> Problem:
    """Return the problem, or None if ANSWERS has how far to the right the dark pixels of PICTURES are."""
    init_node()
    answers, kind = [], dict(rospy.get_published_topics()).get(ANSWERS)
    if kind not in (None, Float32._type):
        return f"{ANSWERS} is {kind}, not {Float32._type}: use Float32 in rospy.Publisher"
    rospy.Subscriber(ANSWERS, Float32, lambda message: answers.append(message.data))
    try:
        picture = rospy.wait_for_message(PICTURES, CompressedImage, TIMEOUT)
    except rospy.ROSException:
        return f"No picture arrives on {PICTURES}: start a simulated robot, or a real one with camera:=true"
    wanted = dark_x(picture.data)
    if wanted is None:
        return f"Nothing in the lower half of the picture is dark: {PUT}"
    if abs(wanted) < MIN_X:
        return f"The line is in the middle of the picture: {PUT}"
    if wait_until(lambda: answers and abs(answers[-1] - wanted) < TOLERANCE, TIMEOUT):
        return None
    if not answers:
        return next(filter(None, map(_check_subscribes, graph.publishers_of(ANSWERS))), SILENT)
    return (f"Your node publishes {answers[-1]:.2f}, and the dark pixels are at {wanted:.2f}: "
            f"{_correction(answers[-1], wanted)}")


def _check_subscribes(node) -> Problem:
    kind = graph.subscriptions_of(node).get(PICTURES)
    if kind is None:
        return f"{node} does not subscribe to {PICTURES}: use that in rospy.Subscriber"
    return None if kind == CompressedImage._type else f"{node} expects {kind}: use CompressedImage in rospy.Subscriber"


def _correction(answer: float, wanted: float) -> str:
    if abs(answer) > 1:
        return "divide by half the width, and subtract 1"
    return "to the right is positive" if abs(answer + wanted) < TOLERANCE else "rows come before columns"


def dark_x(jpeg: bytes) -> Optional[float]:
    """Return where the dark pixels of the lower half are: -1 is the left edge, 1 the right one; None without any."""
    import numpy  # here: the other lessons need neither
    from PIL import Image
    picture = numpy.asarray(Image.open(io.BytesIO(jpeg)).convert("RGB"))
    columns = numpy.nonzero(picture[len(picture) // 2:].mean(axis=2) < DARK)[1]
    return float(2 * columns.mean() / (picture.shape[1] - 1) - 1) if len(columns) else None
