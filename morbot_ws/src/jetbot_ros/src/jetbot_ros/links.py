"""This node's links: its topics known to the master, and a connection to each publisher; ``Links.heal`` repairs them.

rospy connects when the master announces a publisher, and only then. The master announces from three threads without a
time limit (ros_comm#1555): three frozen subscribers, of whatever topic, keep every other node from hearing of new ones.
"""

import contextlib
import errno
import math
import re
import socket
import threading
import time
from typing import Callable, Dict, Iterable, Iterator, List, Optional, Tuple
from urllib.parse import urlsplit

import rosgraph
import rospy
from rospy.exceptions import TransportException
from rospy.impl.masterslave import ROSHandler
from rospy.impl.registration import (
    Registration,
    get_registration_listeners,
    get_service_manager,
    get_topic_manager,
)
from rospy.impl.tcpros_base import TCPROSTransport, read_ros_handshake_header
from rospy.impl.tcpros_pubsub import TCPROSSub

from jetbot.host import is_loopback, is_this_host

from . import failures
from .master import NO_ANSWER, TIMEOUT, CachingTransport, address_of, ask, condition_of, master_uri, proxy

HEAL_INTERVAL = 1.0      # s from one check of the links to the next
HEADER_TIMEOUT = 5.0     # s for a publisher's header
REFUSED_INTERVAL = 30.0  # s until a publisher that has refused, as one of another type does, is asked again
WARN_INTERVAL = 10.0     # s
ENDED = re.compile("is not a publisher of|Internal error processing topic|Node is shutting down")  # rospy's, of a topic
KEEP_ALIVE = {"TCP_KEEPIDLE": 1, "TCP_KEEPINTVL": 1, "TCP_KEEPCNT": 8}  # s, s, probes: after a cut, a link ends in 9 s

Graph = Tuple[Dict[str, List[str]], Dict[str, List[str]], Dict[str, List[str]]]  # as master.system_state returns it

_lock = threading.Lock()
_busy_until: Dict[Tuple[str, str], float] = {}  # by topic and publisher's address: no other thread connects before

on_end: Dict[str, Callable[["Link"], None]] = {}  # by topic: called with each link that has ended, by its own thread


class Links:
    """Checks and repairs the links of this node. timeout: in s, for an answer of the master.

    graph: of all publishers, subscribers and services, as of the last ``heal``.
    """

    def __init__(self, timeout: float = TIMEOUT):
        self.graph: Graph = {}, {}, {}
        self._master = proxy(master_uri(), timeout, CachingTransport)

    def heal(self, before_registering: Callable[[], None] = lambda: None) -> bool:
        """Ask the master once; register what it does not know, connect to each publisher that is not connected.

        Return whether the master knew all of this node. Raise NO_ANSWER.
        """
        told = registered()
        self.graph = tuple(dict(part) for part in ask(self._master, "getSystemState"))
        kinds = dict(zip((Registration.PUB, Registration.SUB, Registration.SRV), self.graph))
        missing = [item for item in told if rospy.get_name() not in kinds[item[2]].get(item[0], ())]
        if missing:
            before_registering()
            register(missing)
        for topic, node in self._unconnected():
            uri = address_of(node)
            if uri:
                threading.Thread(target=connect, args=[topic, uri, node], daemon=True).start()
        return not missing

    def _unconnected(self) -> Iterator[Tuple[str, str]]:
        for topic, subscriber in list(get_topic_manager().subs.items()):
            connected = {connection.callerid_pub for connection in subscriber.connections}
            yield from ((topic, node) for node in self.graph[0].get(topic, ()) if node not in connected)


class Link(TCPROSTransport):
    """A connection to a publisher, as of ``connected_at``. It ends when it breaks off; the next check makes another."""

    def __init__(self, topic: str, subscriber):
        self.connected_at = math.inf
        super().__init__(TCPROSSub(topic, subscriber.data_class, subscriber.queue_size, subscriber.buff_size,
                                   subscriber.tcp_nodelay), topic)

    def read_header(self):
        for option, value in KEEP_ALIVE.items():  # sooner than rospy, which notices after minutes
            self.socket.setsockopt(socket.IPPROTO_TCP, getattr(socket, option), value)
        # Within the time limit of ``connect``, which rospy takes off
        self._validate_header(read_ros_handshake_header(self.socket, self.read_buff, self.protocol.buff_size))
        self.connected_at = time.monotonic()

    def _reconnect(self):
        self.close()


def install() -> None:
    """Let rospy connect by ``connect`` when the master announces publishers; call it before the node is initialized."""
    def connect_topic(_handler, topic, uri):
        connect(topic, uri)
        return 1, "", 0

    ROSHandler._connect_topic = connect_topic


def stay_linked() -> None:
    """From now on, heal this node's links once a second, from a thread."""
    is_over = rospy.core.is_shutdown_requested

    def run():
        links = Links()
        while not is_over():
            with contextlib.suppress(*NO_ANSWER):  # until the master answers
                links.heal()
            time.sleep(HEAL_INTERVAL)

    threading.Thread(target=failures.lasting(run, is_over), daemon=True).start()


def registered() -> List[Tuple[str, str, str]]:
    """Return the topics and services of which rospy has told a master: (name, type or address, kind) of each.

    Raise socket.timeout while it is telling one that does not answer.
    """
    topics, services = get_topic_manager(), get_service_manager()
    with held(topics.lock), held(services.lock):
        return [(name, type_or_uri, kind) for kind, items in (
            (Registration.PUB, topics.get_publications()), (Registration.SUB, topics.get_subscriptions()),
            (Registration.SRV, services.get_services())) for name, type_or_uri in items]


@contextlib.contextmanager
def held(lock) -> Iterator[None]:
    """Hold a lock of rospy's, which it keeps while it registers. Raise socket.timeout if that takes too long."""
    if not lock.acquire(timeout=TIMEOUT):
        raise socket.timeout(errno.ETIMEDOUT, "rospy does not get an answer")
    try:
        yield
    finally:
        lock.release()


def register(items: Iterable[Tuple[str, str, str]]) -> None:
    """Register topics and services, which are as ``registered`` returns them. Raise NO_ANSWER.

    A node that has taken this one's name meanwhile keeps it.
    """
    if address_of(rospy.get_name()) != rospy.get_node_uri() and condition_of(rospy.get_name()):
        return
    topics = get_topic_manager()
    current = {Registration.PUB: topics.pubs, Registration.SUB: topics.subs}
    with topics.lock:  # none may be unregistered meanwhile
        for name, type_or_uri, kind in items:
            if name in current.get(kind, [name]):
                get_registration_listeners().notify_added(name, type_or_uri, kind)


def connect(topic: str, uri: str, node: str = "") -> None:
    """Connect to the publisher at this address, unless it is connected already; receive until the link ends.

    node: its name; a publisher that is gone is then struck off the master's list, as by ``rosnode cleanup``, so that
    nobody asks who has its port next.
    """
    subscriber, place = get_topic_manager().get_subscriber_impl(topic), (topic, uri)
    with _lock:
        if not subscriber or subscriber.has_connection(uri) or _busy_until.get(place, -math.inf) > time.monotonic():
            return
        _busy_until[place] = math.inf
    link, busy_until = None, None
    try:
        link = open_link(topic, subscriber, uri)
        busy_until = None if link else time.monotonic() + REFUSED_INTERVAL
    except (*NO_ANSWER, TransportException) as error:
        if failures.is_lack(error):
            failures.end(error)
        if node and is_gone(error):
            with contextlib.suppress(*NO_ANSWER):
                proxy(master_uri()).unregisterPublisher(node, topic, uri)
    finally:
        with _lock:
            _busy_until.pop(place)
            if busy_until:
                _busy_until[place] = busy_until
    if link:
        link.receive_loop(subscriber.receive_callback)
        on_end.get(topic, lambda _: None)(link)


def open_link(topic: str, subscriber, uri: str) -> Optional[Link]:
    """Return the link to a publisher, or None if that refuses. Raise NO_ANSWER or TransportException."""
    if not may_reach(urlsplit(uri).hostname, uri):
        return None
    _, host, port = ask(proxy(uri), "requestTopic", topic, [["TCPROS"]])
    if not may_reach(host, uri):
        return None
    link = Link(topic, subscriber)
    try:
        link.connect(host, port, uri, HEADER_TIMEOUT)
    except TransportException:
        problem = (link.header or {}).get("error")
        if not problem or ENDED.search(problem):  # which may begin again a moment later
            raise
        rospy.logwarn(f"{topic}: the publisher at {uri[:80]!a} refuses: {problem[:200]!a}")
        return None
    if not subscriber.add_connection(link):
        link.close()
    return link


def is_gone(error: Exception) -> bool:
    """Return whether nobody publishes there any more: no program listens, or one that does not publish this."""
    return isinstance(error, (ConnectionRefusedError, LookupError))


def may_reach(host: object, uri: str) -> bool:
    """Return whether the publisher at this address, on this host, may be connected; log it if not.

    If this node's own address (ROS_HOSTNAME, ROS_IP) is a loopback, only those of this host may: whoever can reach the
    master makes it list publishers anywhere, as a page in a browser of this computer can.
    """
    if not is_loopback(rosgraph.network.get_host_name()) or is_this_host(host):
        return True
    rospy.logwarn_throttle(WARN_INTERVAL, f"refused a publisher at {uri[:80]!a}: "
                                          "ROS_HOSTNAME limits this robot to its own computer")
    return False
