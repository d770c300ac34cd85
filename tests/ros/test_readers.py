"""In a task by camera alone, the judge names who reads where the robot is, and lets those watch that only show it."""

import socket

import pytest

from driving_tasks.sources import readers
from driving_tasks.sources.readers import ASK_INTERVAL, Readers


@pytest.fixture
def ask(monkeypatch):
    """Returns the problem where a node subscribes to a topic. alive: whether it runs."""
    def run(topic, node, alive=True, namespace=""):
        monkeypatch.setattr(readers, "system_state", lambda: [{}, {topic: ["/judge", node]}, {}])
        monkeypatch.setattr(readers, "condition_of", lambda _: alive and "is already running")
        asked = Readers(namespace)
        asked.poll()
        return asked.problem
    return run


@pytest.mark.parametrize("topic, namespace", [
    ("/line", ""), ("/odom", ""), ("/path", ""), ("/joint_states", ""), ("/jetbot_simulator/ground_truth", ""),
    ("/tf", ""), ("/tf", "/red"), ("/red/odom", "/red")])
def test_who_reads_where_the_robot_is_or_its_line_sensor_is_named(ask, topic, namespace):
    assert ask(topic, "/pupil", namespace=namespace) == (
        f"/pupil reads {topic}. End it: in this task, programs see with the camera alone.")


@pytest.mark.parametrize("topic, node, alive", [
    ("/camera/image_raw/compressed", "/pupil", True), ("/cmd_vel", "/pupil", True), ("/red/odom", "/pupil", True),
    ("/odom", "/pupil", False), ("/odom", "/jetbot_cockpit", True), ("/tf", "/rviz", True),
    ("/joint_states", "/robot_state_publisher", True),
    ("/tf", "/rviz_1700000000000000000", True), ("/odom", "/record_1700000000000000000", True),
    ("/odom", "/draw_track_12_1700000000000", True)])
def test_who_may_read(ask, topic, node, alive):
    assert ask(topic, node, alive) == ""


def test_the_master_is_asked_once_a_second_and_its_silence_changes_nothing(ask, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(readers.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(readers, "condition_of", lambda _: True)
    states = iter([[{}, {"/odom": ["/pupil"]}, {}], [{}, {}, {}]])
    monkeypatch.setattr(readers, "system_state", lambda: next(states))
    asked = Readers("")
    asked.poll()
    asked.poll()
    assert asked.problem

    def fail():
        raise socket.timeout
    now[0] += ASK_INTERVAL
    with monkeypatch.context() as patched:
        patched.setattr(readers, "system_state", fail)
        asked.poll()
    assert asked.problem
    now[0] += ASK_INTERVAL
    asked.poll()
    assert not asked.problem
