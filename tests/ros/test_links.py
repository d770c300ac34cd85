"""Who publishes tells each listener itself, whatever the master and the other listeners do."""

import socket
import threading
from types import SimpleNamespace
from xmlrpc.server import SimpleXMLRPCServer

import pytest

from jetbot.wait import wait_until
from jetbot_ros import links

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
        monkeypatch.setattr(links, "address_of", addresses.get)
        monkeypatch.setattr(links.rospy, "get_name", lambda: "/stop")
        publisher = SimpleNamespace(resolved_name=TOPIC,
                                    impl=SimpleNamespace(connections=[SimpleNamespace(endpoint_id="/connected")]))
        graph = {TOPIC: ["/other"]}, {TOPIC: ["/frozen", "/connected", "/dead", "/listener"]}, {}
        links.Announcer(publisher).announce(graph)
        assert wait_until(lambda: told, 10.0)
        assert [words[1:] for words in told] == [(TOPIC, [PUBLISHER, "http://localhost:2/"])]
