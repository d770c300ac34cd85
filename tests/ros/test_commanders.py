"""What a program latches is old if it has sent that before: not what another sends at its address."""

from types import SimpleNamespace

import pytest

from jetbot_control_node.control import commanders
from jetbot_ros import rospy_repairs

URI = "http://localhost:40000/"


class Connection:
    """rospy's connection to a latched publisher of this name."""

    def __init__(self, name):
        self.header, self.endpoint_id = {"callerid": name, "latching": "1"}, URI


class Subscriber:
    """Connections as rospy has them."""

    def __init__(self):
        self.connections = []

    def connect(self, name):
        """Connect to a latched publisher at URI; return its message."""
        self.connections = [Connection(name)]
        return SimpleNamespace(_connection_header=self.connections[0].header)


@pytest.fixture
def subscriber(monkeypatch):
    subscriber = Subscriber()
    monkeypatch.setattr(commanders, "system_state", lambda: [{}])
    monkeypatch.setattr(commanders, "get_topic_manager",
                        lambda: SimpleNamespace(get_subscriber_impl=lambda topic: subscriber))
    rospy_repairs.heard.clear()
    return subscriber


@pytest.mark.parametrize("name, old", [("/order", True), ("/another", False)])
def test_what_a_new_connection_to_the_same_address_delivers(subscriber, name, old):
    senders = commanders.Commanders("/cmd_vel")
    assert not senders.sender(subscriber.connect("/order")).old
    assert senders.sender(subscriber.connect(name)).old is old
    rospy_repairs.heard.clear()  # as when the program has ended
    assert not senders.sender(subscriber.connect(name)).old


def test_an_answer_of_the_masters_from_before_a_program_came_does_not_make_its_order_new(subscriber, monkeypatch):
    senders = commanders.Commanders("/cmd_vel")
    senders.sender(subscriber.connect("/order"))
    broken = SimpleNamespace(callerid_pub="/order", endpoint_id=URI)

    def answer_late():
        senders.sender(subscriber.connect("/order"))
        return [{}]

    monkeypatch.setattr(rospy_repairs, "system_state", answer_late)
    monkeypatch.setattr(rospy_repairs, "get_topic_manager", commanders.get_topic_manager)
    subscriber.remove_connection = lambda connection: None
    assert rospy_repairs.connect_again(broken, "localhost", 0, "/cmd_vel") is None
    assert senders.sender(subscriber.connect("/order")).old
