"""Who publishes tells each listener itself, whatever the master and the other listeners do."""

import contextlib
import socket
import threading
import time
from types import SimpleNamespace
from xmlrpc.server import SimpleXMLRPCServer

import pytest
from rosgraph.network import encode_ros_handshake_header
from rospy.impl.registration import Registration
from std_msgs.msg import Bool

from jetbot.wait import wait_until
from jetbot_ros import announcer, links

TOPIC, PUBLISHER = "/emergency_stop", "http://localhost:1/"


@pytest.fixture
def told():
    """What a listener is told, at the address ``told.uri``."""
    with SimpleXMLRPCServer(("localhost", 0), logRequests=False) as server:
        told = type("Told", (list,), {"uri": f"http://localhost:{server.server_address[1]}/"})()
        server.register_function(lambda *words: told.append(words) or (1, "", 0), "publisherUpdate")
        thread = threading.Thread(target=server.serve_forever, daemon=True)
        thread.start()
        yield told
        server.shutdown()
        thread.join()


def test_each_listener_but_who_is_connected_is_told_beside_one_that_is_frozen(told, monkeypatch):
    with socket.create_server(("localhost", 0)) as frozen:  # it never answers
        addresses = {"/frozen": f"http://localhost:{frozen.getsockname()[1]}/", "/listener": told.uri,
                     "/connected": told.uri, "/dead": None, "/stop": PUBLISHER, "/other": "http://localhost:2/"}
        monkeypatch.setattr(announcer, "address_of", addresses.get)
        monkeypatch.setattr(announcer.rospy, "get_name", lambda: "/stop")
        publisher = SimpleNamespace(resolved_name=TOPIC,
                                    impl=SimpleNamespace(connections=[SimpleNamespace(endpoint_id="/connected")]))
        graph = {TOPIC: ["/other"]}, {TOPIC: ["/frozen", "/connected", "/dead", "/listener"]}, {}
        announcer.Announcer(publisher).announce(graph)
        assert wait_until(lambda: told, 10.0)
        assert [words[1:] for words in told] == [(TOPIC, [PUBLISHER, "http://localhost:2/"])]


def test_what_rospy_is_just_telling_the_master_is_not_missing(monkeypatch):
    known, added = {}, threading.Event()
    topics = SimpleNamespace(lock=threading.Condition(), pubs={}, subs={}, get_publications=lambda: topics.pubs.items(),
                             get_subscriptions=lambda: ())
    services = SimpleNamespace(lock=threading.RLock(), get_services=lambda: ())

    def add():
        with topics.lock:
            topics.pubs[TOPIC] = "std_msgs/Bool"
            added.set()
            time.sleep(0.2)
            known[TOPIC] = ["/stop"]

    monkeypatch.setattr(links.rospy, "get_name", lambda: "/stop")
    monkeypatch.setattr(links, "get_topic_manager", lambda: topics)
    monkeypatch.setattr(links, "get_service_manager", lambda: services)
    monkeypatch.setattr(links, "register", lambda items: pytest.fail(f"again: {items}"))
    monkeypatch.setattr(links, "ask", lambda server, question: (known.items(), (), ()))
    adding = threading.Thread(target=add)
    adding.start()
    assert added.wait(10.0) and links.Links().heal()
    adding.join()


@pytest.fixture
def node(monkeypatch):
    """This node, which listens to TOPIC, and what it does at the master, which knows ``node.graph``."""
    node = SimpleNamespace(graph=({TOPIC: ["/stop", "/new", "/gone"]}, {TOPIC: ["/listener"]}, {}), done=[])
    connected = SimpleNamespace(connections=[SimpleNamespace(callerid_pub="/stop")])
    monkeypatch.setattr(links.rospy, "get_name", lambda: "/listener")
    monkeypatch.setattr(links, "get_topic_manager", lambda: SimpleNamespace(subs={TOPIC: connected}))
    monkeypatch.setattr(links, "registered", lambda: [(TOPIC, "std_msgs/Bool", Registration.SUB)])
    monkeypatch.setattr(links, "ask", lambda *_: [part.items() for part in node.graph])
    monkeypatch.setattr(links, "address_of", {"/new": PUBLISHER}.get)
    monkeypatch.setattr(links, "register", lambda items: node.done.append(("register", *items)))
    monkeypatch.setattr(links, "connect", lambda *place: node.done.append(("connect", *place)))
    return node


def test_a_publisher_that_was_not_announced_is_connected(node):
    assert links.Links().heal()
    assert wait_until(lambda: node.done == [("connect", TOPIC, PUBLISHER, "/new")], 10.0)


@pytest.mark.parametrize("problem, tries", [
    ("[/cockpit] is not a publisher of [/stop]. Topics are []", 2), ("Internal error processing topic [/stop]", 2),
    ("Client [/listener] wants topic [/stop] to have datatype/md5sum [a/b], but our version has [c/d]", 1)])
def test_only_a_publisher_that_will_not_is_left_alone_and_not_one_that_has_just_ended(monkeypatch, problem, tries):
    subscriber = SimpleNamespace(data_class=Bool, queue_size=1, buff_size=65536, tcp_nodelay=True,
                                 has_connection=lambda uri: False)
    monkeypatch.setattr(links, "get_topic_manager",
                        lambda: SimpleNamespace(get_subscriber_impl=lambda topic: subscriber))
    monkeypatch.setattr(links, "_busy_until", {})
    monkeypatch.setattr("rospy.impl.tcpros_base._use_tcp_keepalive", True)  # else it asks a master
    asked = []

    def answer():
        with contextlib.suppress(OSError):  # the server is closed
            while True:
                connection, _ = server.accept()
                with connection:
                    connection.recv(4096)
                    connection.sendall(encode_ros_handshake_header({"error": problem}))

    with socket.create_server(("localhost", 0)) as server:
        monkeypatch.setattr(links, "ask", lambda *_: asked.append(_) or ("TCPROS", "localhost",
                                                                         server.getsockname()[1]))
        threading.Thread(target=answer, daemon=True).start()
        for _ in range(2):
            links.connect(TOPIC, PUBLISHER)
    assert len(asked) == tries


def test_a_master_that_does_not_know_this_node_is_told_once_the_robot_is_held(node):
    node.graph = {}, {}, {}
    assert not links.Links().heal(lambda: node.done.append("hold"))
    assert node.done == ["hold", ("register", (TOPIC, "std_msgs/Bool", Registration.SUB))]


def test_a_node_that_stays_linked_heals_its_links_each_second_whatever_the_master_answers(node, monkeypatch):
    seconds = []
    answers = iter([ConnectionRefusedError, socket.timeout])

    def ask(*_):
        for error in answers:
            raise error
        return [part.items() for part in node.graph]

    monkeypatch.setattr(links, "ask", ask)
    monkeypatch.setattr(links, "time", SimpleNamespace(sleep=seconds.append))
    monkeypatch.setattr(links.rospy, "core", SimpleNamespace(is_shutdown_requested=lambda: len(seconds) >= 4))
    links.stay_linked()
    assert wait_until(lambda: len(node.done) == 2 and len(seconds) == 4, 10.0)
    assert set(seconds) == {1.0}
