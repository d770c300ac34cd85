"""How many connections the cockpit takes, and for how long; with a clock turned by hand."""

import pytest

from jetbot_cockpit_server.connections import MAX_CONNECTIONS, MAX_PER_ADDRESS, MAX_REQUEST_TIME, Connections


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


def test_too_many_from_one_address_close_its_oldest_and_nobody_elses(connections):
    other, *streams = [Stream() for _ in range(MAX_PER_ADDRESS + 3)]
    connections.admit(other, "b", 0.0)
    for stream in streams:
        connections.admit(stream, "a", 0.0)
    assert [stream for stream in streams if stream.closed()] == streams[:2] and not other.closed()


def test_too_many_in_all_close_the_oldest_that_is_no_clients_socket(connections):
    streams = [Stream() for _ in range(MAX_CONNECTIONS + 1)]
    for number, stream in enumerate(streams):
        connections.admit(stream, str(number), 0.0)
        if number == 0:
            connections.keep(stream)
    assert [stream for stream in streams if stream.closed()] == [streams[1]]


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
