"""When the guard stops the wheels, in seconds: docs/safety.md promises these numbers. The clock is simulated."""

from types import SimpleNamespace

import pytest

from jetbot import BusError
from jetbot.boards import BOARDS
from jetbot.guard import process
from jetbot.guard.process import EOF, HEARTBEAT, PING, STOPPED


class World:
    """The guard's clock, what it receives and when, and its board, which answers from some time on. stops: when."""

    def __init__(self, events=(), answers_from=0.0):
        self.now, self.stops, self.answers_from, self._events = 0.0, [], answers_from, list(events)

    def monotonic(self):
        return self.now

    def sleep(self, seconds):
        self.now += seconds

    def read_message(self, _, deadline):
        if deadline is not None and (not self._events or deadline < self._events[0][0]):
            self.now = deadline
            return None
        self.now, message = self._events.pop(0)
        return message

    def stop_board(self, *_):
        if self.now < self.answers_from:
            raise BusError("no answer")
        self.stops.append(round(self.now, 3))


@pytest.fixture
def make_world(monkeypatch):
    """Makes the World in which the guard then runs."""
    def make(*arguments):
        world = World(*arguments)
        monkeypatch.setattr(process, "time", world)
        monkeypatch.setattr(process, "read_message", world.read_message)
        monkeypatch.setattr(process, "stop_board", world.stop_board)
        return world

    monkeypatch.setattr(process, "prepare", lambda: None)
    return make


@pytest.mark.parametrize("events, answers_from, stops", [
    ([(0.0, HEARTBEAT), (0.9, HEARTBEAT), (1.8, HEARTBEAT), (2.7, STOPPED)], 0, []),
    ([(0.0, HEARTBEAT), (0.9, PING), (5.0, EOF)], 0, [1.0, 5.0]),                     # another message is no heartbeat
    ([(0.0, HEARTBEAT), (3.0, HEARTBEAT), (9.0, STOPPED)], 0, [1.0, 4.0]),
    ([(0.0, PING), (60.0, PING), (90.0, EOF)], 0, [90.0]),                            # it need not send heartbeats
    ([(0.0, HEARTBEAT), (9.0, STOPPED)], 1.5, [1.6]),                                 # it tries again every 0.2 s
    ([(0.0, HEARTBEAT), (1.3, HEARTBEAT), (9.0, STOPPED)], 1.5, [2.3]),               # it hung, and goes on
])
def test_a_program_that_hangs_is_stopped_a_second_after_its_last_heartbeat(make_world, events, answers_from, stops):
    world = make_world(events, answers_from)
    process.guard(SimpleNamespace(send=lambda *_: None), BOARDS["jetbot"], "fake")
    assert world.stops == stops


@pytest.mark.parametrize("minutes", [0, 1, 9.9])
def test_a_board_that_answers_within_ten_minutes_is_stopped(make_world, minutes):
    world = make_world([], 60 * minutes)
    process.stop(BOARDS["jetbot"], "fake")
    assert world.stops == [pytest.approx(60 * minutes, abs=0.3)]


def test_a_board_that_never_answers_is_given_up_after_ten_minutes(make_world):
    world = make_world([], 1e9)
    process.stop(BOARDS["jetbot"], "fake")
    assert world.now == pytest.approx(600, abs=0.3)
