"""The programs that publish on a topic, as this node sees them: who they are, and whether they still run."""

import functools
import itertools
import re
import threading
import time
from typing import Any, Callable, Dict, List, Optional

import rospy
from rospy.topics import get_topic_manager

from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER, address_of, ask, proxy, system_state
from jetbot_ros.rospy_repairs import heard

from .state import Sender
from .supervisor import Supervisor

ASK_INTERVAL = 0.25    # s between two questions whether a program still runs
ANSWER_TIMEOUT = 0.6   # s for its answer; state.ANSWER_TIMEOUT allows for one that is late
LATCHED_TIMEOUT = 1.0  # s for what older programs have latched to arrive at a node that has just started
SETTLING_ANSWERS = 4   # of a program that has latched nothing: what it has latched is sent before its first answer
MAX_NAME = 80          # characters of a name that are shown
MANUAL_NODE = "jetbot_cockpit"  # what a person drives with, in whatever namespace


class Commanders:
    """The programs that publish on a topic. Made before its Subscriber, so that it knows which of them are older.

    A program is one connection of rospy's, which knows it by its own number: Linux gives addresses out again.
    """

    def __init__(self, topic: str):
        self._topic = rospy.resolve_name(topic)
        self._older = {node: address_of(node) for node in system_state()[0].get(self._topic, ())}
        self._numbers = itertools.count()
        self._senders: Dict[Any, Sender] = {}   # by connection, from its first message on
        self._headers: Dict[int, Any] = {}      # connections by the id of their header, a new one after an interruption

    def sender(self, message: rospy.Message) -> Optional[Sender]:
        """Return who sent this message, None if that connection has ended; call it once for each message.

        What a latched program delivers first is old if it had published that before this node was there, or before an
        interruption of its connection.
        """
        header = message._connection_header
        connection = self._headers.get(id(header))
        if connection is not None and connection.header is header:
            return self._senders.get(connection)
        return self._first(header)

    def _first(self, header):
        """Return the sender of the first message below this header."""
        connection = next((each for each in self._connections() if each.header is header), None)
        if connection is None:
            return None
        name, latched = shown(header.get("callerid", "")), header.get("latching") == "1"
        before = self._senders.get(connection)
        interrupted = before is not None and before.name == name
        older = self._older.get(header.get("callerid")) == connection.endpoint_id
        self._older.pop(header.get("callerid"), None)
        number = before.number if interrupted else next(self._numbers)
        self._senders[connection] = Sender(name, latched, manual=name.rpartition("/")[2] == MANUAL_NODE, number=number)
        self._headers[id(header)] = connection
        place = self._topic, connection.endpoint_id
        again, heard[place] = heard.get(place) == (name,), (name,)
        return self._senders[connection]._replace(old=latched and (older or again))

    def settle(self) -> List[Any]:
        """Wait, a second at most, until each older program has delivered what it has latched, or has nothing latched.

        Return the latched messages. Call it after the Subscriber is made.
        """
        answers = dict.fromkeys(self._older, 0)
        wait_until(lambda: all(self._has_settled(node, answers) for node in list(self._older)),
                   LATCHED_TIMEOUT if self._older else 0.0, ASK_INTERVAL / 5)
        for node in [node for node, count in answers.items() if count == SETTLING_ANSWERS]:
            self._older.pop(node, None)
        return [connection.latch for connection in self._connections() if connection.latch]

    def _has_settled(self, node, answers):
        """Return whether what an older program has latched is here, or was never there."""
        connection = next((each for each in self._connections() if each.header and each.callerid_pub == node), None)
        if connection is None:
            return False
        answers[node] += answers[node] < SETTLING_ANSWERS and self._answers(connection)
        return connection.latch is not None or not connection.is_latched or answers[node] == SETTLING_ANSWERS

    def watch(self, ended: Callable[[Sender, bool], None] = lambda sender, others: None) -> None:
        """From now on, call ``ended`` with each program that can no longer send, and whether another one can.

        Call it after the Subscriber is made: rospy calls ``remove_connection`` of its topic.
        """
        topic = get_topic_manager().get_subscriber_impl(self._topic)
        remove = topic.remove_connection

        def remove_connection(connection):
            remove(connection)
            for key in [key for key, each in list(self._headers.items()) if each is connection]:
                self._headers.pop(key, None)
            sender = self._senders.pop(connection, None)
            if sender:
                ended(sender, bool(topic.connections))

        with topic.c_lock:
            topic.remove_connection = remove_connection
            for connection in topic.connections:
                connection.set_cleanup_callback(remove_connection)
        for connection in set(self._senders) - set(topic.connections):  # ended meanwhile
            remove_connection(connection)

    def keep_asking(self, supervisor: Supervisor) -> None:
        """From now on, ask the program whose command is held whether it still runs, and confirm its answers."""
        threading.Thread(target=self._ask, args=[supervisor], daemon=True).start()

    def _ask(self, supervisor):
        while not rospy.is_shutdown():
            supervisor.asking.wait()
            time.sleep(ASK_INTERVAL)
            sender, asked_at = supervisor.state.must_answer, time.monotonic()
            connection = sender and next((each for each, known in list(self._senders.items())
                                          if known.number == sender.number), None)
            if connection and self._answers(connection):
                supervisor.confirm(sender, asked_at)

    @staticmethod
    def _answers(connection) -> bool:
        """Return whether the program at the other end of a connection answers."""
        try:
            return bool(ask(proxy(connection.endpoint_id, ANSWER_TIMEOUT), "getPid"))
        except NO_ANSWER:
            return False

    def _connections(self):
        subscriber = get_topic_manager().get_subscriber_impl(self._topic)
        return subscriber.connections if subscriber else []


@functools.lru_cache(maxsize=1000)
def shown(name: str) -> str:
    """Return a name as it may be printed: any program chooses its own."""
    return re.sub(r"[^\w/.~-]", "?", name, flags=re.ASCII)[:MAX_NAME]
