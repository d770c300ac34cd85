"""Which program has a TCP port."""

import os
import socket

import pytest

from jetbot_ros.ports import is_free, processes_on


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
