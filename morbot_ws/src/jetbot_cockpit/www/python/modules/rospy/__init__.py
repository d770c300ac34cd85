"""rospy in the page: the robot's topics, the program's own, and the program's clock."""

from _start import NotHere
from genpy import Duration, Message, Time  # noqa: F401
from std_msgs.msg import Header  # noqa: F401

from .core import *  # noqa: F403
from .exceptions import *  # noqa: F403
from .logs import DEBUG, ERROR, FATAL, INFO, WARN, functions  # noqa: F401
from .timer import Rate, Timer, get_rostime, get_time, sleep, spin  # noqa: F401
from .topics import Publisher, Subscriber, wait_for_message  # noqa: F401

LACKING = """AnyMsg MasterProxy Service ServiceException ServiceProxy SubscribeListener get_master get_node_uri
    get_published_topics remap_name search_param wait_for_service""".split()

globals().update(functions())


def __getattr__(name):
    if name in LACKING:
        raise NotHere("rospy." + name)
    raise AttributeError(f"module 'rospy' has no attribute '{name}'")
