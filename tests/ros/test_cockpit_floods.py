"""What the cockpit does with malformed, endless, frozen and half-open clients, with real sockets."""

import contextlib
import json
import threading
import time

import pytest

from cockpit_server import DRIVE, FIRST_PUPIL, PING, STOP, WITHIN, Cockpit
from jetbot.wait import wait_until
from jetbot_cockpit.session import pages as pages_module
from jetbot_cockpit.web import server as servers
from web_client import PING as PING_FRAME
from web_client import TEXT, connect, head, request

pytest_plugins = ["cockpit_server"]  # its fixtures


@pytest.mark.parametrize("opcode, payload, code, reason", [
    (TEXT, b"x", 4000, "JSON object"), (TEXT, b"{}", 4000, "JSON object"), (TEXT, b"x" * 1001, 4000, "of 1000 bytes"),
    (TEXT, b"x" * 9000, 1009, "message too big"),
    *((opcode, payload, None, "") for opcode, payload in (  # no WebSocket's frames
        (TEXT, b"\xff"), (3, b"{}"), (11, b""), (PING_FRAME, b"x" * 126)))], ids=lambda value: str(value)[:12])
def test_what_is_of_another_form_ends_the_socket_and_stops_the_robot(
        cockpit, opcode, payload, code, reason):
    page = cockpit.page()
    number = page.receive("hello")["id"]
    page.send(DRIVE)
    with contextlib.suppress(ConnectionError):  # what is far too large is not even read
        page.send_frame(opcode, payload)
    closed = page.wait_for_close()
    assert closed.code == code and reason in closed.reason
    assert wait_until(lambda: number in cockpit.control.left, WITHIN)


def test_pings_of_the_protocol_are_no_way_around_the_limit(cockpit):
    page = cockpit.page()
    page.receive("hello")
    with contextlib.suppress(ConnectionError):
        for _ in range(500):
            page.send_frame(PING_FRAME)
    assert page.wait_for_close().reason == pages_module.TOO_MANY


def test_a_frozen_page_delays_nobody_and_is_disconnected(monkeypatch, fresh):
    """Its browser is stopped by SIGSTOP: its socket takes what its buffer holds, and answers no ping."""
    monkeypatch.setattr(pages_module, "GONE_AFTER", 2.0)
    fresh.control.state_size = 50_000
    frozen, other = fresh.page(), fresh.page()
    number = frozen.receive("hello")["id"]
    longest, start = 0.0, time.monotonic()
    last = start
    while not fresh.control.left and last < start + WITHIN:
        other.receive("state")
        longest, last = max(longest, time.monotonic() - last), time.monotonic()
    assert fresh.control.left == [number]
    assert longest < 2


def slow_requests(port):
    """Return the beginnings of requests that are never sent to their ends, and one whose answer nobody reads."""
    host = {"Host": f"localhost:{port}"}
    login = {**host, "Origin": f"http://localhost:{port}", "Content-Type": "application/json", "Content-Length": "30"}
    return [b"", b"GET / HT", head("GET", "/", host)[:-2], head("POST", "/login", login) + b"{"]


def test_connections_that_send_nothing_or_half_a_request_end(monkeypatch):
    monkeypatch.setattr(servers, "IDLE_TIMEOUT", 0.5)
    cockpit = Cockpit()
    connections = [connect(cockpit.port) for _ in slow_requests(cockpit.port)]
    for connection, data in zip(connections, slow_requests(cockpit.port)):
        connection.sendall(data)
    assert [connection.recv(1) for connection in connections] == [b""] * len(connections)
    cockpit.server.end()


@pytest.mark.parametrize("beginning", [b"", b"GET / HT", b"GET / HTTP/1.1\r\nHost: localhost:%d\r\n\r\n"])
def test_connections_that_send_nothing_keep_out_no_page_and_no_stop(monkeypatch, fresh, beginning):
    """The oldest one goes, at the address that has the most; the sockets of pages stay."""
    monkeypatch.setattr(servers, "MAX_CONNECTIONS", 20)
    page, other = fresh.page(), connect(fresh.port, "127.0.0.3")
    idle = [connect(fresh.port, "127.0.0.2") for _ in range(60)]
    for connection in idle[-15:]:
        connection.sendall(beginning.replace(b"%d", b"%d" % fresh.port))
    for phone in "127.0.0.2", "127.0.0.1", "127.0.0.4":
        assert request(fresh.port, "GET", "/", fresh.headers(), phone=phone).status == 200
        assert fresh.page(phone=phone).receive("hello")
    assert [connection.recv(1) for connection in idle[:40]] == [b""] * 40
    other.sendall(head("GET", "/", fresh.headers()))
    assert other.recv(8) == b"HTTP/1.1"
    page.send(STOP)
    assert wait_until(lambda: [message.type for _, message in fresh.control.handled] == ["stop"], WITHIN)


def frames(*messages):
    """Return WebSocket frames with these messages, to send at once."""
    texts = [json.dumps(message).encode() for message in messages]
    return b"".join(bytes([0x81, 0x80 | len(text), 0, 0, 0, 0]) + text for text in texts)


def test_a_stop_in_a_flood_counts(cockpit):
    page = cockpit.page(phone="127.0.0.2")
    number = page.receive("hello")["id"]
    page.connection.sendall(frames(*[PING] * 300, STOP, *[PING] * 300))
    assert page.wait_for_close().reason == pages_module.TOO_MANY
    assert wait_until(lambda: [message for client, message in cockpit.control.handled
                               if client.id == number and message.type == "stop"], WITHIN)


def test_who_comes_back_at_once_after_a_flood_is_not_let_in_and_others_are(monkeypatch, fresh):
    monkeypatch.setattr(pages_module, "FLOOD_PAUSE", 60.0)
    page = fresh.page(phone="127.0.0.2")
    page.connection.sendall(frames(*[PING] * 100))
    reason = pages_module.TOO_MANY
    assert page.wait_for_close().reason == fresh.page(phone="127.0.0.2").wait_for_close().reason == reason
    cookie = fresh.cookie(FIRST_PUPIL)
    for sender in {"phone": "127.0.0.3"}, {"phone": "127.0.0.2", "name": "class.test", "Cookie": cookie}:
        assert fresh.page(**sender).receive("hello")


def test_clients_that_send_without_a_pause_are_not_the_only_ones_that_are_served(cockpit):
    """One with and one without access; their frames are pings without content."""
    page, flooders = cockpit.page(), [cockpit.page(name) for name in ("localhost", "class.test")]
    page.receive("state")

    def flood(flooder):
        with contextlib.suppress(OSError):
            while True:
                flooder.connection.sendall(b"\x89\x80\0\0\0\0" * 10_000)
    threads = [threading.Thread(target=flood, args=[flooder], daemon=True) for flooder in flooders]
    for thread in threads:
        thread.start()
    start, longest = time.monotonic(), 0.0
    while any(thread.is_alive() for thread in threads) and time.monotonic() < start + WITHIN:
        asked = time.monotonic()
        page.send(PING)
        page.receive("pong")
        longest = max(longest, time.monotonic() - asked)
        for thread in threads:
            thread.join(1 / 20)
    assert not any(thread.is_alive() for thread in threads) and longest < 2


@pytest.mark.parametrize("request_head", [
    b"GET / HTTP/1.1\r\nHost: {host}\r\nX: %s\r\n\r\n" % (b"x" * 20_000), b"\0" * 20_000, b"GET\r\n\r\n",
    b"POST /login HTTP/1.1\r\nHost: {host}\r\nContent-Length: 99999999999\r\n\r\n",
    b"POST /login HTTP/1.1\r\nHost: {host}\r\nTransfer-Encoding: chunked\r\n\r\n7d0\r\n" + b"x" * 2000],
    ids=["headers", "zeros", "line", "body", "chunked"])
def test_a_huge_or_malformed_request_ends_its_connection(cockpit, request_head):
    with connect(cockpit.port) as connection:
        with contextlib.suppress(ConnectionError):
            connection.sendall(request_head.replace(b"{host}", b"localhost:%d" % cockpit.port))
            assert connection.makefile("rb").read().split(b" ")[1:2] in ([], [b"400"])
    assert request(cockpit.port, "GET", "/", cockpit.headers()).status == 200
