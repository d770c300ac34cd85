"""The heartbeat of the page, by which a robot is stopped; the widgets are replaced."""

import sys
import types

import pytest

from jetbot.wait import wait_until

pytest.importorskip("traitlets")


class FloatText:
    """A widget; those that are linked answer each pulse, while ``answers``."""

    answers = True
    linked = None

    def __init__(self, value=0.0):
        self.value = value

    def __setattr__(self, name, value):
        object.__setattr__(self, name, value)
        if name == "value" and self.linked and self.answers:
            self.linked.value = value


def jsdlink(source, target):
    source[0].linked = target[0]


@pytest.fixture
def heartbeat(monkeypatch):
    monkeypatch.setitem(sys.modules, "ipywidgets", types.SimpleNamespace(FloatText=FloatText, jsdlink=jsdlink))
    monkeypatch.delitem(sys.modules, "jetbot.heartbeat", raising=False)
    from jetbot import Heartbeat
    heartbeat = Heartbeat(period=0.05)
    yield heartbeat
    heartbeat.stop()


def test_it_lives_while_the_page_answers_and_dies_and_lives_again(heartbeat):
    seen = []

    def observer(change):
        seen.append(change["new"].name)
        raise OSError("an observer that fails ends nothing")

    heartbeat.observe(observer, names="status")
    assert wait_until(lambda: heartbeat.status == heartbeat.Status.alive, 10)
    first = heartbeat.pulseout.value
    assert wait_until(lambda: heartbeat.pulseout.value > first + 0.2, 10) and "dead" not in seen
    heartbeat.pulseout.answers = False
    assert wait_until(lambda: heartbeat.status == heartbeat.Status.dead, 10)
    heartbeat.pulseout.answers = True
    assert wait_until(lambda: heartbeat.status == heartbeat.Status.alive, 10)
    assert seen[-2:] == ["dead", "alive"]


def test_a_clock_that_is_set_back_keeps_no_dead_page_alive(heartbeat, monkeypatch):
    import time
    monkeypatch.setattr(time, "time", lambda: 0.0)
    heartbeat.pulseout.answers = False
    assert wait_until(lambda: heartbeat.status == heartbeat.Status.dead, 10)
