"""The programs that publish on a topic, as this node sees them: who they are, and whether they still run."""

import functools
import re
import threading
import time
from typing import Any, Dict, List, Set, Tuple

import rospy
from rospy.topics import get_topic_manager

from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER, address_of, ask, proxy, system_state

from .state import Sender
from .supervisor import Supervisor

ASK_INTERVAL = 0.25    # s between two questions whether a program still runs
ANSWER_TIMEOUT = 0.6   # s for its answer; state.ANSWER_TIMEOUT allows for one that is late
LATCHED_TIMEOUT = 1.0  # s for a latched message to arrive at a node that has just started
MAX_NAME = 80          # characters of a name that are shown
MANUAL_NODE = "jetbot_cockpit"  # what a person drives with, in whatever namespace


class Commanders:
    """The programs that publish on a topic. Made before its Subscriber, so that it knows which of them are older."""

    def __init__(self, topic: str):
        self._topic = rospy.resolve_name(topic)
        self._known = {address_of(node) for node in system_state()[0].get(self._topic, ())}
        self._senders: Dict[int, Tuple[dict, Sender]] = {}  # by the id of a connection's header, which is kept alive

    def sender(self, message: rospy.Message) -> Sender:
        """Return who sent this message; call it once for each, in the subscriber's callback.

        What a latched publisher delivers first is old if that program was there before this node, or before an
        interruption of its connection.
        """
        header = message._connection_header
        _, sender = self._senders.get(id(header), (header, None))
        return sender or self._first(header)

    def wait_for_latched(self) -> List[Any]:
        """Return the latched messages of the programs that were there before; wait a second for them at most."""
        expected = len(self._known)
        wait_until(lambda: sum(map(delivered, self._connections())) >= expected, LATCHED_TIMEOUT if expected else 0.0)
        return [connection.latch for connection in self._connections() if connection.latch]

    def watch(self, supervisor: Supervisor) -> None:
        """From now on, report to the supervisor which programs end, and that the one whose command is held runs.

        Call it after the Subscriber is made: rospy calls ``remove_connection`` of its topic.
        """
        topic = get_topic_manager().get_subscriber_impl(self._topic)
        remove = topic.remove_connection

        def remove_connection(connection):
            remove(connection)
            supervisor.disconnect(self._names())

        with topic.c_lock:
            topic.remove_connection = remove_connection
            for connection in topic.connections:
                connection.set_cleanup_callback(remove_connection)
        threading.Thread(target=self._ask, args=[supervisor], daemon=True).start()

    def _ask(self, supervisor):
        while not rospy.is_shutdown():
            time.sleep(ASK_INTERVAL)
            name, asked_at = supervisor.state.held_for, time.monotonic()
            if name and self._answers(name):
                supervisor.confirm(name, asked_at)

    def _answers(self, name):
        addresses = [each.endpoint_id for each in self._connections() if shown(each.callerid_pub) == name]
        try:
            return bool(addresses and ask(proxy(addresses[0], ANSWER_TIMEOUT), "getPid"))
        except NO_ANSWER:
            return False

    def _connections(self):
        subscriber = get_topic_manager().get_subscriber_impl(self._topic)
        return subscriber.connections if subscriber else []

    def _names(self) -> Set[str]:
        return {shown(connection.callerid_pub) for connection in self._connections() if connection.header}

    def _first(self, header):
        """Return the sender of the first message on a connection."""
        address = next((each.endpoint_id for each in self._connections() if each.header is header), None)
        latched = header.get("latching") == "1"
        name = shown(header.get("callerid", ""))
        sender = Sender(name, latched, manual=name.rpartition("/")[2] == MANUAL_NODE)
        old = latched and address in self._known
        self._known.add(address)
        # In place: other connections' threads do the same. Connections second: none is missing that has a sender.
        for ended in set(self._senders) - {id(each.header) for each in self._connections()}:
            self._senders.pop(ended, None)
        self._senders[id(header)] = header, sender
        return sender._replace(old=old)


def delivered(connection) -> bool:
    """Return whether the connection is made, and has delivered what its publisher has latched."""
    return bool(connection.header) and (not connection.is_latched or connection.latch is not None)


@functools.lru_cache(maxsize=1000)
def shown(name: str) -> str:
    """Return a name as it may be printed: any program chooses its own."""
    return re.sub(r"[^\w/.~-]", "?", name, flags=re.ASCII)[:MAX_NAME]
