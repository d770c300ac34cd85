"""The cockpit's server with real sockets: who gets in, and what it does with forged, endless and frozen clients."""

import contextlib
import json
import logging
import threading
import time

import pytest

from jetbot.wait import wait_until
from jetbot_cockpit import hub as hubs
from jetbot_cockpit import protocol
from jetbot_cockpit import server as servers
from jetbot_cockpit.access import Access, make_grants
from jetbot_cockpit.handout import make_card
from jetbot_cockpit.hub import Hub
from jetbot_cockpit.listeners import listen
from jetbot_cockpit.server import Server
from web_client import PING as PING_FRAME
from web_client import UPGRADE, WebSocket, connect, head, request

WITHIN = 10.0  # s, less than hubs.GONE_AFTER
GRANTS = make_grants(2)
TEACHER, FIRST_PUPIL, _ = GRANTS
PING = {"type": "ping", "sent": 1}
DRIVE = {"type": "drive", "robot": "/", "forward": 1, "left": 0}


class StandIn:
    """A control that notes what it is asked for. state_size: characters of a status, which changes all the time."""

    def __init__(self):
        self.handled, self.left, self.state_size = [], [], 1

    def handle(self, client, message, now):
        self.handled.append((client, message))

    def leave(self, client, now):
        self.left.append(client)

    def check(self, now):
        return []

    def robots(self):
        return []

    def trails(self):
        return []

    def state(self, now):
        return {"type": "state", "emergency": False, "robots": {}, "status": f"{now} {'x' * self.state_size}"}


class Cockpit:
    """A server on a free port, and what its pages send."""

    def __init__(self):
        sockets = listen(0, lan=False)
        self.port = sockets[0].getsockname()[1]
        self.access = Access(self.port, ["class.test"], GRANTS)
        self.control = StandIn()
        self.server = Server(sockets, self.access, Hub(
            self.control, [make_card(grant, "class.test", self.port) for grant in GRANTS]))
        self.server.start()

    def headers(self, name="localhost", **headers):
        """Return the headers of a page that was opened by this name; None leaves one out."""
        host = f"{name}:{self.port}"
        given = {"Host": host, "Origin": f"http://{host}", **headers}
        return {name.replace("_", "-"): value for name, value in given.items() if value is not None}

    def log_in(self, code, **headers):
        headers = {"Content_Type": "application/json", **headers}
        return request(self.port, "POST", "/login", self.headers("class.test", **headers),
                       json.dumps({"code": code}).encode())

    def cookie(self, grant):
        return self.log_in(grant.code).headers["set-cookie"].partition(";")[0]

    def page(self, name="localhost", **headers):
        """Return a new page's socket."""
        return WebSocket(self.port, self.headers(name, **headers))


@pytest.fixture(scope="module")
def cockpit():
    cockpit = Cockpit()
    yield cockpit
    cockpit.server.end()


@pytest.fixture
def fresh():
    """A cockpit whose wrong codes and clients are this test's own."""
    cockpit = Cockpit()
    yield cockpit
    cockpit.server.end()


def foreign_hosts(port):
    return ["", "evil.test", f"evil.test:{port}", "localhost", "localhost:1", f"localhost:{port}.evil.test",
            f"evil@localhost:{port}", f"localhost.:{port}", f"127.0.0.1:{port + 1}", f"0.0.0.0:{port}",
            f"localhost:{port}, evil.test"]


def foreign_origins(port):
    return [None, "", "null", "http://evil.test", f"http://evil.test:{port}", "http://localhost", "http://localhost:1",
            f"https://localhost:{port}", f"http://localhost:{port}.evil.test", f"http://localhost:{port}/",
            f"http://localhost:{port}, http://evil.test"]


def test_a_browser_of_this_computer_needs_no_code(cockpit):
    for name in "localhost", "127.0.0.1":
        assert cockpit.page(name).receive("hello")["role"] == "teacher"


def test_every_answer_has_the_headers_that_protect_the_page(cockpit):
    host = cockpit.headers()
    answers = {
        200: request(cockpit.port, "GET", "/", host), 404: request(cockpit.port, "GET", "/other", host),
        403: request(cockpit.port, "POST", "/login", {**host, "Origin": "http://evil.test"}),
        415: request(cockpit.port, "POST", "/login", host), 405: request(cockpit.port, "GET", "/login", host)}
    answers[4040] = request(cockpit.port, "GET", "/", {"Host": "evil.test"})
    for status, answer in answers.items():
        assert str(status).startswith(str(answer.status))
        assert "frame-ancestors 'none'" in answer.headers["content-security-policy"]
        assert "default-src 'self'" in answer.headers["content-security-policy"]
        assert [answer.headers[name] for name in (
            "x-frame-options", "x-content-type-options", "referrer-policy", "cache-control")] == [
                "DENY", "nosniff", "no-referrer", "no-store"]
        assert not {"server", "access-control-allow-origin", "set-cookie"} & set(answer.headers)


@pytest.mark.parametrize("path", ["/../package.xml", "/%2e%2e/package.xml", "/www/index.html", "//etc/passwd",
                                  "/index.html/", "/.", "/main.js%00", "/socket/", "/login/"])
def test_nothing_but_the_pages_files_is_served(cockpit, path):
    assert request(cockpit.port, "GET", path, cockpit.headers()).status == 404


def test_a_page_by_a_foreign_name_is_not_found(cockpit):
    """DNS rebinding: a foreign page's name is resolved to this computer's address."""
    for host in foreign_hosts(cockpit.port):
        headers = {**cockpit.headers(), "Host": host}
        assert request(cockpit.port, "GET", "/", headers).status == 404, host
        assert request(cockpit.port, "GET", "/socket", {**headers, **UPGRADE}).status == 404, host
        assert request(cockpit.port, "POST", "/login", headers).status == 404, host


def test_a_foreign_page_gets_no_socket_and_no_post(cockpit):
    for origin in foreign_origins(cockpit.port):
        assert cockpit.page(Origin=origin).status == 403, origin
        assert cockpit.log_in(TEACHER.code, Origin=origin).status == 403, origin


def test_a_code_becomes_a_cookie_that_scripts_and_other_pages_do_not_get(cockpit):
    answer = cockpit.log_in(FIRST_PUPIL.code)
    assert answer.status == 204
    flags = answer.headers["set-cookie"].lower()
    assert "httponly" in flags and "samesite=strict" in flags and "path=/" in flags
    for _ in range(2):  # it lives through a reconnect
        hello = cockpit.page("class.test", Cookie=cockpit.cookie(FIRST_PUPIL)).receive("hello")
        assert (hello["role"], hello["robot"]) == ("pupil", "/jetbot_01")


@pytest.mark.parametrize("cookie", [None, "", "jetbot_cockpit=x", "{name}=", "{name}=x", "{name}={code}"])
def test_without_a_cookie_that_is_known_a_page_is_asked_to_log_in(cockpit, cookie):
    name = cockpit.access.cookie_name
    page = cockpit.page("class.test", Cookie=cookie and cookie.format(name=name, code=TEACHER.code))
    assert page.wait_for_close().code == 4001


@pytest.mark.parametrize("body, status", [
    (b"", 400), (b"x", 400), (b"[]", 400), (b"{}", 400), (b'{"code": 1}', 400), (b'{"code": "A", "x": 1}', 400),
    (b"[" * 900, 400), (b'{"code": "\\ud800"}', 403), (b"\xff\xfe", 400),
    (b'{"code": "%s"}' % (b"A" * 2000), 400)],
    ids=lambda value: str(value)[:20])
def test_a_login_of_another_form_is_refused(cockpit, body, status):
    headers = cockpit.headers(Content_Type="application/json")
    assert request(cockpit.port, "POST", "/login", headers, body).status == status


@pytest.mark.parametrize("kind", ["text/plain", "application/x-www-form-urlencoded", "", "multipart/form-data; b=x"])
def test_a_login_is_json_only(cockpit, kind):
    """A foreign page's form cannot send JSON."""
    assert cockpit.log_in(TEACHER.code, Content_Type=kind).status in (400, 415)


def test_nothing_acts_on_get(cockpit):
    assert request(cockpit.port, "GET", f"/login?code={TEACHER.code}", cockpit.headers()).status == 405
    for method in "PUT", "DELETE", "PATCH", "OPTIONS":
        assert request(cockpit.port, method, "/login", cockpit.headers()).status == 405


def test_after_five_wrong_codes_not_even_the_right_one_gets_in(fresh):
    assert [fresh.log_in("WRONG").status for _ in range(6)] == [403] * 5 + [429]
    assert fresh.log_in(TEACHER.code).status == 429


def test_what_a_page_sends_reaches_the_control_and_a_ping_returns(cockpit):
    page = cockpit.page()
    number = page.receive("hello")["id"]
    page.send(DRIVE)
    page.send({"type": "ping", "sent": 12.5})
    assert page.receive("pong") == {"type": "pong", "sent": 12.5}
    client, message = cockpit.control.handled[-1]
    assert (client.id, message) == (number, protocol.Drive("/", 1, 0))


def test_a_teacher_gets_the_codes_and_a_pupil_does_not(cockpit):
    teacher, pupil = cockpit.page(), cockpit.page("class.test", Cookie=cockpit.cookie(FIRST_PUPIL))
    for page in teacher, pupil:
        page.send({"type": "codes"})
    assert [card["code"] for card in teacher.receive("codes")["codes"]] == [grant.code for grant in GRANTS]
    assert pupil.receive("notice")["text"] == "Only a teacher sees the codes."


@pytest.mark.parametrize("message", [
    b"", b"x", b"[]", b"{}", b'{"type": "fly"}', b'{"type": "drive"}', b'{"type": "ping", "sent": NaN}',
    b'{"type": "ping", "sent": 1%s}' % (b"0" * 400), b"x" * 1001, b"x" * 8000, b"x" * 100_000], ids=len)
def test_a_message_of_another_form_ends_the_socket_and_stops_the_robot(cockpit, message):
    page = cockpit.page()
    number = page.receive("hello")["id"]
    page.send(DRIVE)
    with contextlib.suppress(ConnectionError):  # what is far too large is not even read
        page.send(message)
    closed = page.wait_for_close()
    assert closed.code in ((4000,) if len(message) <= 8000 else (1009, None))
    assert wait_until(lambda: number in cockpit.control.left, WITHIN)


def test_a_binary_message_ends_the_socket(cockpit):
    page = cockpit.page()
    page.send_frame(2, json.dumps(PING).encode())
    assert page.wait_for_close().code == 4000


def test_too_many_messages_end_the_socket_but_a_stop_among_them_counts(cockpit):
    page = cockpit.page()
    number = page.receive("hello")["id"]
    with contextlib.suppress(ConnectionError):
        for _ in range(80):
            page.send({"type": "stop"})
    closed = page.wait_for_close()
    assert (closed.code, closed.reason) == (4000, hubs.TOO_MANY)
    stops = [message for client, message in cockpit.control.handled if client.id == number]
    assert stops == [protocol.Stop()] * len(stops) and len(stops) > protocol.MAX_BURST


def test_the_pages_rate_after_a_pause_of_the_network_is_no_flood(cockpit):
    page = cockpit.page()
    for _ in range(45):
        page.send(PING)
    for _ in range(45):
        assert page.receive("pong")


def test_pings_of_the_protocol_are_no_way_around_the_limit(cockpit):
    page = cockpit.page()
    page.receive("hello")
    with contextlib.suppress(ConnectionError):
        for _ in range(500):
            page.send_frame(PING_FRAME)
    assert page.wait_for_close().reason == hubs.TOO_MANY


def test_the_sixty_fifth_client_is_told_that_there_is_no_room(fresh):
    pages = [fresh.page() for _ in range(hubs.MAX_CLIENTS)]
    for page in pages:
        page.receive("hello")
    assert fresh.page().wait_for_close().code == 4002
    pages[0].close()
    assert wait_until(lambda: fresh.control.left, WITHIN)
    assert fresh.page().receive("hello")


def test_a_killed_page_stops_its_robot_at_once(cockpit):
    page = cockpit.page()
    number = page.receive("hello")["id"]
    page.close()
    assert wait_until(lambda: number in cockpit.control.left, WITHIN)


def test_frames_go_to_all_pages_twenty_times_a_second(fresh):
    pages = [fresh.page() for _ in range(3)]
    for page in pages:
        page.receive("state")
    start = time.monotonic()
    for page in pages:
        for _ in range(20):
            page.receive("state")
    assert 0.5 < time.monotonic() - start < 5


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


def test_idle_connections_shut_nobody_out(fresh):
    page = fresh.page()
    idle = [connect(fresh.port) for _ in range(150)]
    assert request(fresh.port, "GET", "/", fresh.headers()).status == 200
    page.send(PING)
    assert page.receive("pong")
    assert idle[0].recv(1) == b""


@pytest.mark.parametrize("name", ["localhost", "class.test"])
def test_a_client_that_sends_without_a_pause_is_not_the_only_one_that_is_served(cockpit, name):
    """With and without access; its frames are pings without content."""
    page, flooder = cockpit.page(), cockpit.page(name)
    page.receive("state")

    def flood():
        with contextlib.suppress(OSError):
            while True:
                flooder.connection.sendall(b"\x89\x80\0\0\0\0" * 10_000)
    thread = threading.Thread(target=flood, daemon=True)
    thread.start()
    start, longest = time.monotonic(), 0.0
    while thread.is_alive() and time.monotonic() < start + WITHIN:
        asked = time.monotonic()
        page.send(PING)
        page.receive("pong")
        longest = max(longest, time.monotonic() - asked)
        thread.join(1 / 20)
    assert not thread.is_alive() and longest < 2


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


def test_nothing_is_logged_that_a_client_can_cause(caplog, cockpit):
    with caplog.at_level(logging.DEBUG):
        cockpit.log_in(TEACHER.code)
        cockpit.log_in("WRONG")
        request(cockpit.port, "GET", f"/{TEACHER.code}", cockpit.headers())
        page = cockpit.page()
        page.send(b"x")
        page.wait_for_close()
    assert TEACHER.code not in caplog.text and "WRONG" not in caplog.text
