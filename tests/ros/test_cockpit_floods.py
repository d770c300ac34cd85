"""What the cockpit does with malformed, endless, frozen and half-open clients, with real sockets."""

import contextlib
import logging
import threading
import time

import pytest

from cockpit_server import DRIVE, PING, WITHIN, Cockpit
from jetbot.wait import wait_until
from jetbot_cockpit_server.session import hub as hubs
from jetbot_cockpit_server.web import server as servers
from web_client import PING as PING_FRAME
from web_client import TEXT, connect, head, request

pytest_plugins = ["cockpit_server"]  # its fixtures


@pytest.mark.parametrize("opcode, payload, code, reason", [
    (TEXT, b"x", 4000, "JSON object"), (TEXT, b"{}", 4000, "JSON object"), (TEXT, b"x" * 1001, 4000, "of 1000 bytes"),
    (TEXT, b"x" * 9000, 1009, "message too big"),
    *((opcode, payload, 1002, "a frame is not of the WebSocket protocol") for opcode, payload in (
        (TEXT, b"\xff"), (3, b"{}"), (11, b""), (PING_FRAME, b"x" * 126)))], ids=lambda value: str(value)[:12])
def test_what_is_of_another_form_ends_the_socket_with_a_reason_and_stops_the_robot(
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
    assert page.wait_for_close().reason == hubs.TOO_MANY


def test_a_frozen_page_delays_nobody_and_is_disconnected(monkeypatch, fresh):
    """Its browser is stopped by SIGSTOP: its socket takes what its buffer holds, and answers no ping."""
    monkeypatch.setattr(hubs, "GONE_AFTER", 2.0)
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


def test_more_connections_than_there_is_room_for_end_and_those_that_there_are_stay(monkeypatch, fresh):
    monkeypatch.setattr(servers, "MAX_CONNECTIONS", 2)
    page, idle = fresh.page(), connect(fresh.port)
    assert connect(fresh.port).recv(1) == b""
    idle.setblocking(False)
    with pytest.raises(BlockingIOError):  # it is still open
        idle.recv(1)
    page.send(PING)
    assert page.receive("pong")
    idle.close()

    def is_served():
        with contextlib.suppress(ConnectionError, IndexError):  # IndexError: not even a status
            return request(fresh.port, "GET", "/", fresh.headers()).status == 200
    assert wait_until(is_served, WITHIN)


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


def test_the_end_disconnects_all_pages_and_logs_nothing(caplog):
    cockpit = Cockpit()
    pages = [cockpit.page() for _ in range(3)]
    for page in pages:
        page.receive("state")
    with caplog.at_level(logging.DEBUG):
        cockpit.server.end()
    assert [page.wait_for_close().code for page in pages] == [1001] * 3
    assert len(cockpit.control.left) == 3
    assert not caplog.records
    with pytest.raises(ConnectionError):
        connect(cockpit.port)
