"""A robot lets in nobody but the hub of its class, and a hub believes no robot that only says its name."""

import asyncio
import json

import pytest
from hub_world import Liar, Relay, answer, identity

from cockpit_server import WITHIN
from jetbot.wait import wait_until
from jetbot_cockpit.remote.fleet import Fleet
from jetbot_cockpit.remote.key import RELAYED, WRONG_KEY
from jetbot_cockpit.session.protocol import SILENT
from jetbot_cockpit.web import hub_socket
from web_client import Closed

pytest_plugins = ["hub_world"]  # its fixtures

DEEP = {"links": json.loads(800 * "[" + 800 * "]")}


@pytest.fixture
def robot(make_robot):
    return make_robot()


def proven(fleet, robot, **fields):
    """Return a socket that has proven to be a hub's."""
    socket = robot.connect()
    socket.send(answer(fleet, socket, **fields))
    socket.receive("proof")
    return socket


def test_who_has_the_key_is_a_teacher(fleet, robot):
    socket = proven(fleet, robot)
    assert socket.receive("hello")["role"] == "teacher"
    socket.send({"type": "stop"})
    assert wait_until(lambda: robot.control.stopped, WITHIN)
    socket.close()


def refused(socket, message):
    socket.send(message)
    return socket.wait_for_close()


def test_who_has_another_key_is_refused_and_logged_once_a_minute(fleet, robot, tmp_path, caplog):
    hub_socket.REFUSALS = hub_socket.Refusals()
    other = Fleet(str(tmp_path / "other"), "7b")
    for _ in range(3):
        socket = robot.connect()
        assert refused(socket, answer(other, socket)).code == WRONG_KEY
    assert [record.getMessage() for record in caplog.records if "refused" in record.getMessage()] == [
        "a hub at 127.0.0.1 was refused: it has another key"]
    assert robot.done == []


def test_a_recording_is_worth_nothing(fleet, robot):
    first, second = robot.connect(), robot.connect()
    recorded = answer(fleet, first)
    first.send(recorded)
    assert first.receive("proof")
    second.receive("challenge")
    assert refused(second, recorded).code == WRONG_KEY
    first.close()


def test_a_command_the_robots_own_proof_and_another_robots_key_are_no_hubs(fleet, robot):
    for change in ({"proof": None}, {"proof": 7}, {"nonce": ["a"]}, {"proof": "ä"}, {"nonce": 32 * "A"},
                   {"frames": False}, {"link": "b"}, {"more": 1}, DEEP):
        socket = robot.connect()
        assert refused(socket, {**answer(fleet, socket), **change}).code == WRONG_KEY
    socket = robot.connect()
    theirs = answer(fleet, socket, robot="jetbot_02")
    assert refused(socket, theirs).code == WRONG_KEY
    assert refused(robot.connect(), {"type": "stop"}).code == WRONG_KEY
    assert robot.done == []


def test_who_proves_nothing_is_ended_soon(robot, monkeypatch):
    monkeypatch.setattr(hub_socket, "HANDSHAKE_TIMEOUT", 0.1)
    assert robot.connect().wait_for_close().code == SILENT


def test_a_browser_gets_no_challenge(robot):
    assert robot.connect(Origin=f"http://{robot.address}").status == 403


def test_a_message_of_a_megabyte_ends_the_socket(fleet, robot):
    socket = proven(fleet, robot)
    with pytest.raises((Closed, ConnectionError)):
        socket.send(b"x" * (1 << 20))
        while True:
            socket.receive()


def test_a_link_that_connects_again_ends_its_socket_from_before(fleet, robot):
    first = proven(fleet, robot, hub="1", link="a", links=["a"])
    other = proven(fleet, robot, hub="1", link="b", links=["a", "b"])
    stranger = proven(fleet, robot, hub="2", link="a", links=["a"])
    second = proven(fleet, robot, hub="1", link="a", links=["a", "b"])
    assert first.wait_for_close().reason == "the hub has connected again"
    for socket in other, stranger, second:
        socket.send({"type": "ping", "sent": 1})
        assert socket.receive("pong")
        socket.close()


def test_a_link_that_a_hub_has_closed_while_it_was_cut_off_ends(fleet, robot):
    closed = proven(fleet, robot, hub="1", link="a", links=["a"])
    new = proven(fleet, robot, hub="1", link="b", links=["b"])
    assert closed.wait_for_close().reason == "the hub has connected again"
    new.close()


def test_who_wants_no_frames_is_sent_none(fleet, robot):
    socket = proven(fleet, robot, frames=False)
    watching = proven(fleet, robot)
    assert watching.receive("state") and watching.receive("state")
    socket.send({"type": "ping", "sent": 1})
    kinds = []
    while kinds[-1:] != ["pong"]:
        kinds.append(socket.receive()["type"])
    assert not {"state", "robots"} & set(kinds)
    for each in socket, watching:
        each.close()


def status(hub, robot="/jetbot_01"):
    return hub.hub._robots.states().get(robot, {}).get("status")


@pytest.mark.parametrize("key_of, class_name, socket, problem, logged", [
    ("jetbot_02", "7b", hub_socket.HubSocket, "jetbot_01 has another key than this class's.", True),
    ("jetbot_01", "8a", hub_socket.HubSocket, "The robot at {} is of another class.", False),
    ("jetbot_01", "7b", Liar, "What answers at {} pretends to be jetbot_01.", False)],
    ids=["another key", "another class", "repeats the hub's proof"])
def test_who_is_not_of_the_class_is_named(fleet, make_robot, make_hub, key_of, class_name, socket, problem, logged):
    robot = make_robot(who=identity(fleet, key_of=key_of)._replace(class_name=class_name), socket=socket)
    hub, text = make_hub({"jetbot_01": robot}), problem.format(robot.address)
    assert wait_until(lambda: status(hub) == text, WITHIN), status(hub)
    assert not logged or wait_until(lambda: list(hub.hub.log) == [text], WITHIN), hub.hub.log


def test_who_passes_a_handshake_on_is_refused_and_named_at_both_ends(robot, make_robot, make_hub, caplog):
    hub_socket.REFUSALS = hub_socket.Refusals()
    relay = make_robot(socket=Relay.to(robot))
    hub = make_hub({"jetbot_01": relay})
    text = f"What answers at {relay.address} passes on what jetbot_01 says: enter the robot's own address."
    assert wait_until(lambda: text in hub.hub.log, WITHIN), hub.hub.log
    assert status(hub) == text and not hub.hub._robots.connected() and robot.done == []
    assert f"a hub at 127.0.0.1 was refused: it has connected to {relay.address}, which passes on what it says to " \
        f"{robot.address}" in [record.getMessage() for record in caplog.records]


def test_who_changes_the_address_that_a_hub_has_dialled_proves_nothing(fleet, robot):
    socket = robot.connect()
    elsewhere = answer(fleet, socket, address="127.0.0.1:1")
    assert refused(socket, elsewhere).code == RELAYED
    socket = robot.connect()
    assert refused(socket, {**answer(fleet, socket, address="127.0.0.1:1"), "address": robot.address}).code == WRONG_KEY


class Slow(hub_socket.HubSocket):
    """A robot whose answer is long on its way."""

    def _let_in(self, answer):
        asyncio.get_running_loop().call_later(0.3, super()._let_in, answer)


def test_a_robot_whose_proof_is_on_its_way_has_no_wrong_key(make_robot, make_hub):
    hub = make_hub({"jetbot_01": make_robot(socket=Slow)}, connected=1)
    assert list(hub.hub.log) == []


def test_an_address_that_is_none_and_a_name_that_nobody_has_say_so(make_hub):
    hub = make_hub({"jetbot_01": "no such host:x", "jetbot_02": "nobody.invalid"})
    texts = ["No connection to no such host:x.", "No connection to nobody.invalid:8080."]
    assert wait_until(lambda: [status(hub), status(hub, "/jetbot_02")] == texts, WITHIN), status(hub)


def test_a_clone_is_named_and_the_first_robot_stays(make_robot, make_hub):
    first, clone = make_robot(), make_robot(instance="2")
    hub = make_hub({"jetbot_01": first}, connected=1)
    hub.fleet.save([*hub.fleet.robots, hub.fleet.robots[0]._replace(name="jetbot_02", address=clone.address)])
    text = f"Two robots are called jetbot_01: {first.address} and {clone.address}. Give one another name."
    assert wait_until(lambda: "/jetbot_02" in hub.hub._robots.states() and status(hub, "/jetbot_02") == text, WITHIN)
    page = hub.page()
    page.send({"type": "drive", "robot": "/jetbot_01", "forward": 1, "left": 0})
    page.send({"type": "stop"})
    assert wait_until(lambda: first.control.stopped and clone.control.stopped, WITHIN)
    page.close()
    assert {kind for kind, _ in clone.done} == {"stop"}
