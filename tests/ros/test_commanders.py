"""What a program has latched is old if it has latched that before: not what another sends at its address."""

import time
from types import SimpleNamespace

import pytest

from jetbot_control_node.control import commanders
from jetbot_ros import links

URI = "http://localhost:40000/"


class Subscriber:
    """rospy's links to the publishers of a topic."""

    def __init__(self):
        self.connections = []

    def connect(self, name, seconds_ago=0.0):
        """Connect to a latched publisher at URI; return its message."""
        header = {"callerid": name, "latching": "1"}
        self.connections = [SimpleNamespace(header=header, endpoint_id=URI, latch=None, is_latched=True,
                                            callerid_pub=name, connected_at=time.monotonic() - seconds_ago)]
        return SimpleNamespace(_connection_header=header)

    def break_off(self):
        """End the link."""
        link, = self.connections
        self.connections = []
        links.on_end["/cmd_vel"](link)


@pytest.fixture
def subscriber(monkeypatch):
    subscriber = Subscriber()
    monkeypatch.setattr(commanders, "system_state", lambda: [{"/cmd_vel": ["/older"]}])
    monkeypatch.setattr(commanders, "address_of", lambda node: URI)
    monkeypatch.setattr(commanders, "get_topic_manager",
                        lambda: SimpleNamespace(get_subscriber_impl=lambda topic: subscriber))
    return subscriber


@pytest.mark.parametrize("name, seconds_ago, old", [
    ("/older", 0.0, True), ("/older", 5.0, False), ("/newer", 0.0, False)])
def test_what_a_program_from_before_this_nodes_start_has_latched_is_old(subscriber, name, seconds_ago, old):
    message = subscriber.connect(name, seconds_ago)
    senders = commanders.Commanders("/cmd_vel")
    assert senders.sender(message).old is old
    assert not senders.sender(message).old


@pytest.mark.parametrize("name, old", [("/order", True), ("/another", False)])
def test_what_a_new_link_to_the_same_address_delivers(subscriber, name, old):
    ended = []
    senders = commanders.Commanders("/cmd_vel", lambda sender, others: ended.append((sender.name, others)))
    first = senders.sender(subscriber.connect("/order"))
    assert not first.old
    subscriber.break_off()
    assert ended == [("/order", False)]
    second = senders.sender(subscriber.connect(name))
    assert second.old is old and second.number != first.number


def test_only_so_many_programs_are_remembered(subscriber, monkeypatch):
    monkeypatch.setattr(commanders, "MAX_KNOWN", 10)
    senders = commanders.Commanders("/cmd_vel")
    for number in range(30):
        senders.sender(subscriber.connect(f"/order{number}"))
    assert senders.sender(subscriber.connect("/order29")).old
    assert not senders.sender(subscriber.connect("/order1")).old


@pytest.mark.parametrize("latched, latch, seconds_ago, waits", [
    (True, "stop", 0.0, False), (False, None, 0.0, False), (True, None, 0.0, True), (True, None, 0.5, False)])
def test_a_start_waits_for_what_an_older_program_may_have_latched(subscriber, monkeypatch, latched, latch, seconds_ago,
                                                                waits):
    monkeypatch.setattr(commanders, "LATCHED_WITHIN", 0.1)
    senders = commanders.Commanders("/cmd_vel")
    subscriber.connect("/older", seconds_ago)
    subscriber.connections[0].__dict__.update(is_latched=latched, latch=latch)
    started = time.monotonic()
    assert senders.settle() == ([latch] if latch else [])
    assert (time.monotonic() - started >= 0.1) is waits
