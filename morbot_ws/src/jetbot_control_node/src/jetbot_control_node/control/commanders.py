"""The programs that publish on a topic, as this node sees them: who they are, and whether they still run."""

import functools
import itertools
import re
import threading
import time
from typing import Any, Callable, Dict, List, Optional, Tuple

import rospy
from rospy.topics import get_topic_manager

from jetbot.wait import wait_until
from jetbot_ros import links
from jetbot_ros.contract import COCKPIT
from jetbot_ros.master import NO_ANSWER, address_of, ask, proxy, system_state

from .state_machine import Sender
from .supervisor import Supervisor

ASK_INTERVAL = 0.25    # s between two questions whether a program still runs
ANSWER_TIMEOUT = 0.6   # s for its answer; state.ANSWER_TIMEOUT allows for one that is late
LATCHED_WITHIN = 1.0   # s from a connection until what its publisher has latched has arrived: it is sent at once
SETTLE_TIMEOUT = 0.3   # s of these for which a node waits at its start
MAX_KNOWN = 1000       # programs that are remembered
MAX_NAME = 80          # characters of a name that are shown


class Commanders:
    """The programs that publish on a topic. Made before its Subscriber, so that it knows which of them are older.

    A program is one link, which has a number of its own: Linux gives addresses out again.
    ended: called with each program that can no longer send, and whether another one can.
    """

    def __init__(self, topic: str, ended: Callable[[Sender, bool], None] = lambda sender, others: None):
        self._topic, self._ended = rospy.resolve_name(topic), ended
        self._known = {node: address_of(node) for node in system_state()[0].get(self._topic, ())}
        self._numbers = itertools.count()
        self._senders: Dict[int, Tuple[Any, Sender]] = {}  # links from their first message on, by the id of the header
        links.on_end[self._topic] = self._forget

    def sender(self, message: rospy.Message) -> Optional[Sender]:
        """Return who sent this message, None if that link has ended; call it once for each message.

        What a program has latched before this node's start, or before its connection broke off, is old.
        """
        header = message._connection_header
        link, sender = self._senders.get(id(header), (None, None))
        return sender if link else self._first(header)

    def _first(self, header):
        """Return the sender of the first message of a link."""
        link = next((each for each in self._links() if each.header is header), None)
        if link is None:
            return None
        node, latched = header.get("callerid", ""), header.get("latching") == "1"
        name = shown(node)
        sender = Sender(name, latched, manual=name.rpartition("/")[2] == COCKPIT, number=next(self._numbers))
        self._senders[id(header)] = link, sender
        before = self._known.pop(node, None) == link.endpoint_id
        self._known[node] = link.endpoint_id
        if len(self._known) > MAX_KNOWN:
            self._known.pop(next(iter(self._known)))
        return sender._replace(old=latched and before and time.monotonic() - link.connected_at < LATCHED_WITHIN)

    def settle(self) -> List[Any]:
        """Wait until what older programs have latched is here, as far as it comes. Return the latched messages.

        Call it after the Subscriber is made.
        """
        wait_until(lambda: all(map(self._has_settled, self._known)), LATCHED_WITHIN if self._known else 0.0)
        return [link.latch for link in self._links() if link.latch]

    def _has_settled(self, node):
        return any(link.callerid_pub == node and (
            link.latch or not link.is_latched or time.monotonic() - link.connected_at > SETTLE_TIMEOUT)
            for link in self._links())

    def _forget(self, link):
        _, sender = self._senders.pop(id(link.header), (None, None))
        if sender:
            self._ended(sender, bool(self._links()))

    def keep_asking(self, supervisor: Supervisor) -> None:
        """From now on, ask the program whose command is held whether it still runs, and confirm its answers."""
        threading.Thread(target=self._ask, args=[supervisor], daemon=True).start()

    def _ask(self, supervisor):
        while not rospy.is_shutdown():
            supervisor.asking.wait()
            time.sleep(ASK_INTERVAL)
            sender, asked_at = supervisor.state.must_answer, time.monotonic()
            link = sender and next((link for link, known in list(self._senders.values())
                                    if known.number == sender.number), None)
            if link and answers(link.endpoint_id):
                supervisor.confirm(sender, asked_at)

    def _links(self):
        subscriber = get_topic_manager().get_subscriber_impl(self._topic)
        return subscriber.connections if subscriber else []


def answers(uri: str) -> bool:
    """Return whether the program at this address answers."""
    try:
        return bool(ask(proxy(uri, ANSWER_TIMEOUT), "getPid"))
    except NO_ANSWER:
        return False


@functools.lru_cache(maxsize=1000)
def shown(name: str) -> str:
    """Return a name as it may be printed: any program chooses its own."""
    return re.sub(r"[^\w/.~-]", "?", name, flags=re.ASCII)[:MAX_NAME]
