"""The dead man's switch, with a clock turned by hand."""

import pytest

from jetbot_cockpit_server.session.dead_man import TIMEOUT, DeadMan


@pytest.fixture
def driven():
    """A switch that was fed at 10 s."""
    switch = DeadMan()
    assert switch.feed(10.0)
    return switch


def test_it_fires_when_no_command_came_for_its_timeout(driven):
    assert all(driven.feed(10 + 0.05 * number) for number in range(21))
    assert driven.remaining(11 + 0.1) == pytest.approx(TIMEOUT - 0.1)
    assert not driven.check(11 + TIMEOUT - 0.01)
    assert driven.check(11 + TIMEOUT) and driven.remaining(12) == 0


def test_a_command_that_comes_too_late_is_driven_only_after_the_pad_was_let_go(driven):
    assert not driven.feed(10.4), "nobody has looked meanwhile"
    assert not any(driven.feed(10.4 + 0.05 * number) for number in range(100))
    driven.let_go()
    assert driven.feed(20)


def test_it_never_fires_while_the_robot_is_not_driven(driven):
    driven.let_go()
    assert not driven.check(1e9) and driven.remaining(1e9) is None
    assert not DeadMan().check(1e9)
