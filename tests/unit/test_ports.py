"""Which program has a TCP port, and what the doctor prints about that of the cockpit's page."""

import os
import socket
import subprocess
import sys

import pytest

from jetbot_ros.ports import is_free, processes_on
from jetbot_tools import probe

LISTENER = "import socket, sys; server = socket.create_server(('localhost', int(sys.argv[1]))); print(); input()"


@pytest.fixture(params=[(socket.AF_INET, "127.0.0.1"), (socket.AF_INET, "0.0.0.0"), (socket.AF_INET6, "::1")], ids=str)
def taken(request):
    """A port on which this process listens, at one address."""
    family, address = request.param
    try:
        with socket.create_server((address, 0), family=family) as server:
            yield server.getsockname()[1]
    except OSError as error:
        pytest.skip(str(error))  # no IPv6


def test_a_port_is_taken_while_a_process_listens_there(taken):
    assert not is_free(taken)
    assert processes_on(taken) == [os.getpid()]


def test_a_port_is_free_again_at_once():
    with socket.create_server(("localhost", 0)) as server:
        port = server.getsockname()[1]
        with socket.create_connection(("localhost", port)):
            server.accept()[0].close()  # the kernel keeps such a connection for a minute
    assert is_free(port)
    assert processes_on(port) == []
    assert probe.check_cockpit_port(port) == []


@pytest.fixture
def listener(tmp_path):
    """Return a function that starts a program of this name, which listens; it returns its port and its id."""
    started = []

    def start(name):
        with socket.create_server(("localhost", 0)) as server:
            port = server.getsockname()[1]
        (tmp_path / name).write_text(LISTENER)
        started.append(subprocess.Popen([sys.executable, tmp_path / name, str(port)], stdin=subprocess.PIPE,
                                        stdout=subprocess.PIPE))
        started[-1].stdout.readline()
        return port, started[-1].pid

    yield start
    for process in started:
        process.communicate(b"\n", timeout=30)


def test_the_doctor_names_the_program_that_has_the_port(listener):
    port, pid = listener("other.py")
    assert [str(check) for check in probe.check_cockpit_port(port)] == [
        f"NOT port {port}: in use by other.py ({pid}). The cockpit needs another one: cockpit_port:={port + 1}"]


def test_the_doctor_names_no_program_that_it_may_not_see(listener, monkeypatch):
    port, _ = listener("other.py")
    monkeypatch.setattr(probe, "processes_on", lambda port: [])
    assert "in use by a program of another user." in str(probe.check_cockpit_port(port)[0])


def test_a_cockpit_that_runs_is_no_problem(listener):
    assert probe.check_cockpit_port(listener("cockpit.py")[0]) == []
