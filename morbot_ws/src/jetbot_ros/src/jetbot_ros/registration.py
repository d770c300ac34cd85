"""Whether the ROS master knows this node, and how a master that was restarted gets to know it."""

import rospy
from rospy.impl.registration import (
    Registration,
    get_registration_listeners,
    get_service_manager,
    get_topic_manager,
)

from .addresses import master_uri
from .master import condition_of
from .xmlrpc import proxy

TIMEOUT = 2.0  # s for an answer; the robot is stopped before
_master = None


def is_registered() -> bool:
    """Return whether the master knows this node; raise NO_ANSWER."""
    global _master
    _master = _master or proxy(master_uri(), TIMEOUT)  # keeps its connection
    code, _, uri = _master.lookupNode(rospy.get_name(), rospy.get_name())
    return code == 1 and uri == rospy.get_node_uri()


def register() -> None:
    """Register all topics and services of this node; wait until the master answers. Raise NO_ANSWER.

    A node that has taken this one's name meanwhile keeps it.
    """
    if condition_of(rospy.get_name()):
        return
    topics, services = get_topic_manager(), get_service_manager()
    for kind, items in ((Registration.PUB, topics.get_publications()), (Registration.SUB, topics.get_subscriptions()),
                        (Registration.SRV, services.get_services())):
        for name, type_or_uri in items:
            get_registration_listeners().notify_added(name, type_or_uri, kind)
