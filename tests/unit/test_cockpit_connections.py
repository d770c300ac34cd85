"""How many connections the cockpit takes, and for how long; with a clock turned by hand."""

import pytest

from jetbot_cockpit.connections import MAX_CONNECTIONS, MAX_PER_ADDRESS, MAX_REQUEST_TIME, Connections


class Stream:
    """A connection that is open until somebody closes it."""

    def __init__(self):
        self.ended = False

    def close(self):
        self.ended = True

    def closed(self):
        return self.ended


@pytest.fixture
def connections():
    return Connections()


def test_one_address_leaves_room_for_the_others(connections):
    streams = [Stream() for _ in range(MAX_PER_ADDRESS + 1)]
    assert [connections.admit(stream, "a", 0.0) for stream in streams] == [True] * MAX_PER_ADDRESS + [False]
    assert streams[-1].closed() and connections.admit(Stream(), "b", 0.0)
    streams[0].close()
    assert connections.admit(Stream(), "a", 0.0)


def test_there_is_a_limit_for_all_addresses(connections):
    admitted = [connections.admit(Stream(), str(number), 0.0) for number in range(MAX_CONNECTIONS + 1)]
    assert admitted == [True] * MAX_CONNECTIONS + [False]


def test_only_a_clients_socket_stays_open(connections):
    kept, slow = Stream(), Stream()
    for stream in kept, slow:
        connections.admit(stream, "a", 0.0)
    connections.keep(kept)
    connections.expire(MAX_REQUEST_TIME)
    assert not slow.closed()
    connections.expire(MAX_REQUEST_TIME + 0.1)
    assert slow.closed() and not kept.closed()
    connections.close()
    assert kept.closed()
