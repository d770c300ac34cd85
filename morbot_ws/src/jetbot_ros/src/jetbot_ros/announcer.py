"""Tells the listeners of a topic that this node publishes it, as the ROS master may be unable to: see ``links``."""

import contextlib
import threading

import rospy

from .links import Graph
from .master import NO_ANSWER, address_of, ask, proxy


class Announcer:
    """Tells the subscribers of a publisher's topic about it. Never blocks."""

    def __init__(self, publisher: rospy.Publisher):
        self._publisher = publisher
        self._told = set()  # who is being told

    def announce(self, graph: Graph) -> None:
        """Tell each subscriber that is not connected yet, each from a thread of its own."""
        publishers, subscribers, _ = graph
        topic = self._publisher.resolved_name
        connected = {connection.endpoint_id for connection in self._publisher.impl.connections}
        for node in set(subscribers.get(topic, ())) - connected - self._told:
            self._told.add(node)
            threading.Thread(target=self._tell, args=[topic, node, publishers.get(topic, [])], daemon=True).start()

    def _tell(self, topic, node, publishers):
        with contextlib.suppress(*NO_ANSWER):
            uris = {*map(address_of, {*publishers, rospy.get_name()})} - {None}  # all: roscpp drops the others
            ask(proxy(address_of(node)), "publisherUpdate", topic, sorted(uris))
        self._told.discard(node)
