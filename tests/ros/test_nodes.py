"""check_lesson.py believes no node: an answer may be forged, endless or late, and the process id another's."""

import contextlib
import subprocess
import sys
import threading
import time
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from itertools import repeat
from xmlrpc.client import dumps

import pytest
import rosgraph

from jetbot_lessons import graph, nodes


class Forger(BaseHTTPRequestHandler):
    """A node that answers each call with the bytes ``reply``."""

    reply = b""

    def do_POST(self):  # noqa: N802
        self.send_response(200)
        self.end_headers()
        with contextlib.suppress(ConnectionError):  # the caller has heard enough
            for part in self.reply:
                self.wfile.write(part)

    def log_message(self, *_):
        pass


@pytest.fixture
def answer(monkeypatch):
    """A function that makes the bytes or the value given the answer of every node."""
    server = ThreadingHTTPServer(("localhost", 0), Forger)
    threading.Thread(target=server.serve_forever, args=[0.01], daemon=True).start()
    uri = f"http://localhost:{server.server_port}/"
    monkeypatch.setattr(rosgraph.Master, "lookupNode", lambda *_: uri)
    yield lambda value: setattr(Forger, "reply", value if hasattr(value, "__next__") else iter(
        [value if isinstance(value, bytes) else dumps((value,), methodresponse=True).encode()]))
    server.shutdown()
    server.server_close()


@pytest.mark.parametrize("value", [
    b"", b"\xff\0garbage", b"<?xml", b"<methodResponse/>", 5, "text", [], [1, "", "../../etc"], [1, "", -1.5],
    [1, "", ["x"]], [0, "refused", 5], {"a": 1}], ids=repr)
def test_what_is_no_process_id(answer, value):
    answer(value)
    start = time.monotonic()
    assert nodes.pid("/forged") is None
    assert time.monotonic() - start < nodes.TIMEOUT
    answer(value)
    assert graph._types("/forged") == {}


@pytest.mark.parametrize("parts, within", [
    (repeat(b" " * 10**6), nodes.TIMEOUT), ((time.sleep(0.5) or b" " for _ in range(10)), 2 * nodes.TIMEOUT)],
    ids=["endless", "slow"])
def test_an_answer_that_does_not_end(answer, parts, within):
    answer(parts)
    start = time.monotonic()
    assert nodes.pid("/forged") is None
    assert time.monotonic() - start < within


def test_the_command_is_that_of_the_process_that_listens_and_not_of_the_one_reported(answer, tmp_path):
    script = tmp_path / "drive.py"
    script.write_text("input()")
    with subprocess.Popen([sys.executable, script], stdin=subprocess.PIPE) as other:
        answer([1, "", other.pid])
        command = nodes.command_of("/forged")
        other.communicate(b"\n")
    assert command and script not in command
