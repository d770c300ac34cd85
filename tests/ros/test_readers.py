"""In a task by camera alone, the judge names who reads where the robot is, and lets those watch that only show it."""

import socket

import pytest

from driving_tasks.sources import readers
from driving_tasks.sources.readers import ASK_INTERVAL, Readers


@pytest.fixture
def ask(monkeypatch):
    """Returns the problem where a node subscribes to a topic. alive: whether it runs."""
    def run(topic, node, alive=True, namespace="", command=()):
        monkeypatch.setattr(readers, "system_state", lambda: [{}, {topic: ["/judge", node]}, {}])
        monkeypatch.setattr(readers, "condition_of", lambda _: alive and "is already running")
        monkeypatch.setattr(readers, "command_of", lambda _: command)
        asked = Readers(namespace)
        asked.poll(moves=False)
        return str(asked.problem or "")
    monkeypatch.setattr(readers.rospy, "get_name", lambda: "/judge")
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
    ("/tf", "/rviz_1700000000000000000", True), ("/odom", "/record_1700000000000000000", True)])
def test_who_may_read(ask, topic, node, alive):
    assert ask(topic, node, alive) == ""


@pytest.mark.parametrize("program, may", [
    ("/ws/devel/lib/jetbot_cockpit/cockpit.py", True), ("/ws/src/jetbot_cockpit/scripts/cockpit.py", True),
    ("/usr/lib/rosbag/record", True), ("/usr/bin/rviz", True), ("/ws/devel/lib/my_scenario/record", False),
    ("/ws/src/my_scenario/scripts/cockpit.py", False), ("/home/me/rviz.py", False)])
@pytest.mark.parametrize("node", ["/record", "/red/judge", "/jetbot_cockpit", "/pupil"])
def test_a_name_makes_no_watcher(ask, node, program, may):
    assert (ask("/odom", node, command=["/usr/bin/python3.8", program]) == "") is may


@pytest.mark.parametrize("looks, moves, blind", [
    (["/pupil"] * 9, True, False), (["/record"] * 9, True, True), (["/record", "/record", "/pupil"] * 3, True, False),
    (["/pupil", "/record"], True, False), (["/record"] * 9, False, False)])
def test_somebody_looks_while_the_robot_moves(monkeypatch, looks, moves, blind):
    states = iter([[{}, {"/red/camera/image_raw/compressed": [node]}, {}] for node in looks])
    monkeypatch.setattr(readers, "system_state", lambda: next(states))
    monkeypatch.setattr(readers, "condition_of", lambda _: True)
    monkeypatch.setattr(readers, "command_of", lambda _: [])
    monkeypatch.setattr(readers, "ASK_INTERVAL", 0.0)
    asked = Readers("/red")
    for _ in looks:
        asked.poll(moves=moves)
    assert asked.are_blind is blind
    asked.start()
    assert not asked.are_blind


def test_the_master_is_asked_once_a_second_and_its_silence_changes_nothing(ask, monkeypatch):
    now = [100.0]
    monkeypatch.setattr(readers.time, "monotonic", lambda: now[0])
    monkeypatch.setattr(readers, "condition_of", lambda _: True)
    states = iter([[{}, {"/odom": ["/pupil"]}, {}], [{}, {}, {}]])
    monkeypatch.setattr(readers, "system_state", lambda: next(states))
    asked = Readers("")
    asked.poll(moves=False)
    asked.poll(moves=False)
    assert asked.problem

    def fail():
        raise socket.timeout
    now[0] += ASK_INTERVAL
    with monkeypatch.context() as patched:
        patched.setattr(readers, "system_state", fail)
        asked.poll(moves=False)
    assert asked.problem
    now[0] += ASK_INTERVAL
    asked.poll(moves=False)
    assert not asked.problem
