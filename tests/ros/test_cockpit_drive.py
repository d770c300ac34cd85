"""The thread that drives a robot, and its emergency stop, with a stand-in for their publishers."""

import itertools
import threading
import time
from types import SimpleNamespace

import pytest
import rospy

from jetbot.wait import wait_until
from jetbot_cockpit.robots import robot_topics
from jetbot_cockpit.robots.command_publishers import Drivers
from jetbot_cockpit.session.lease import COMMAND_TIMEOUT, Lease
from jetbot_cockpit.session.rights import Client

TIMEOUT = 5.0  # s


def commanded(ago=0.0):
    """Return the lease of a command that came so many seconds ago."""
    return Lease(Client(1, "pupil"), time.monotonic() - ago, driving=True)


class Publisher:
    """Notes what is published. at_end: what is called while the first one ends."""

    impl = type("Impl", (), {"connections": ()})

    def __init__(self, topic, *_, **__):
        self.opened.append(topic)

    def publish(self, message):
        self.published.append((message.linear.x, message.angular.z))

    def unregister(self):
        while self.at_end:
            self.at_end.pop()()
        self.ended.append(1)


@pytest.fixture
def publisher(monkeypatch):
    Publisher.opened, Publisher.published, Publisher.ended, Publisher.at_end = [], [], [], []
    monkeypatch.setattr(rospy, "Publisher", Publisher)
    return Publisher


def threads():
    return [thread for thread in threading.enumerate() if thread.name == "/red/cmd_vel"]


@pytest.mark.parametrize("let_go, ago, published", [
    (True, 0.0, [(0.5, 0.1), (0.0, 0.0)]), (False, 0.0, [(0.5, 0.1), (0.0, 0.0)]),
    (False, COMMAND_TIMEOUT, [(0.0, 0.0)])], ids=["a release", "silence", "a command that is too old"])
def test_a_drive_ends_with_one_zero_and_then_its_publisher_has_ended(publisher, let_go, ago, published):
    drivers = Drivers()
    drivers.drive("/red", (0.5, 0.1), commanded(ago))
    assert wait_until(lambda: publisher.published, TIMEOUT)
    if let_go:
        drivers.let_go("/red")
        drivers.close()
        assert publisher.published == published
    assert wait_until(lambda: publisher.ended and not threads(), TIMEOUT)
    assert publisher.opened == ["/red/cmd_vel"] and publisher.published == published


def test_a_command_while_the_publisher_ends_is_driven_by_another(publisher):
    drivers = Drivers()
    publisher.at_end.append(lambda: drivers.drive("/red", (0.2, 0.0), commanded()))
    drivers.drive("/red", (0.5, 0.0), commanded())
    drivers.let_go("/red")
    assert wait_until(lambda: (0.2, 0.0) in publisher.published, TIMEOUT)
    drivers.close()
    assert publisher.published[-1] == (0.0, 0.0)
    assert wait_until(lambda: not threads(), TIMEOUT)
    assert len(publisher.opened) == len(publisher.ended) == 2


def test_a_robot_that_is_driven_again_soon_keeps_its_publisher(publisher):
    drivers = Drivers()
    for speed in 0.5, 0.2:
        drivers.drive("/red", (speed, 0.0), commanded())
        assert wait_until(lambda speed=speed: (speed, 0.0) in publisher.published, TIMEOUT)
        drivers.let_go("/red")
        assert wait_until(lambda: publisher.published[-1] == (0.0, 0.0), TIMEOUT)
    assert len(publisher.opened) == 1


def test_programs_wait_by_zeros_until_they_may_drive_on(publisher):
    drivers = Drivers()
    assert drivers.resumes_in("/red", time.monotonic()) < 0
    drivers.keep_waiting("/red", True)
    assert wait_until(lambda: len(publisher.published) == 3, TIMEOUT)
    assert set(publisher.published) == {(0.0, 0.0)} and 4 < drivers.resumes_in("/red", time.monotonic()) < 5
    drivers.keep_waiting("/red", False)
    assert wait_until(lambda: publisher.ended and not threads(), TIMEOUT)


def test_a_shutdown_of_the_node_ends_the_thread(publisher, monkeypatch):
    def closed(*_):
        raise rospy.ROSException("publish() to a closed topic")

    monkeypatch.setattr(publisher, "publish", closed)
    Drivers().drive("/red", (0.5, 0.0), commanded())
    assert wait_until(lambda: publisher.ended and not threads(), TIMEOUT)


class Stop:
    """An emergency stop; what it publishes, and a clock that is turned by hand."""

    def __init__(self, monkeypatch):
        self.published, self.now, callbacks = [], 100.0, []
        impl = SimpleNamespace(connections=[])
        monkeypatch.setattr(rospy, "Publisher", lambda *_, **__: SimpleNamespace(
            publish=self.published.append, resolved_name="/emergency_stop", impl=impl))
        monkeypatch.setattr(rospy, "Subscriber", lambda topic, kind, callback: callbacks.append(callback))
        monkeypatch.setattr(robot_topics.time, "monotonic", lambda: self.now)
        self.stop, self.receive = robot_topics.StopTopic("/emergency_stop", lambda: ({}, {}, {})), callbacks[0]

    def release(self):
        """Another program's release arrives."""
        self.receive(SimpleNamespace(data=False, _connection_header={"callerid": "/terminal"}))


@pytest.fixture
def stop(monkeypatch):
    return Stop(monkeypatch)


def test_a_release_that_was_on_its_way_when_the_stop_was_pressed_does_not_undo_it(stop):
    stop.stop.set(True)
    stop.release()
    assert stop.stop.engaged and stop.published == [True, True]
    stop.now += 1.0
    stop.release()
    assert not stop.stop.engaged and stop.published == [True, True, False]


def test_a_stop_that_is_pressed_while_the_cockpit_looks_at_a_release_is_not_undone(stop):
    looks, press = itertools.count(1), threading.Thread(target=stop.stop.set, args=[True])

    class Release(SimpleNamespace):
        @property
        def data(self):
            if next(looks) == 2:  # it has found that the stop is undone
                press.start()
                press.join(0.5)  # unless it waits
            return False
    stop.stop.set(True)
    stop.now += 1.0
    stop.receive(Release(_connection_header={"callerid": "/terminal"}))
    press.join(TIMEOUT)
    assert stop.stop.engaged and stop.stop.latched and stop.published[-1] is True
