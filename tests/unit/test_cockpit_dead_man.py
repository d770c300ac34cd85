"""The dead man's switch, with a clock turned by hand."""

import pytest

from jetbot_cockpit_server.dead_man import TIMEOUT, DeadMan


@pytest.fixture
def driven():
    """A switch that was fed at 10 s."""
    switch = DeadMan()
    assert switch.feed(10.0)
    return switch


def test_commands_that_keep_arriving_are_driven(driven):
    assert all(driven.feed(10 + 0.05 * i) for i in range(100))


def test_it_fires_when_none_came_for_its_timeout(driven):
    assert not driven.check(10 + TIMEOUT - 0.01)
    assert driven.check(10 + TIMEOUT)


def test_a_command_that_comes_too_late_is_not_driven_even_if_nobody_looked_meanwhile(driven):
    assert not driven.feed(10.4)


def test_once_fired_only_a_release_makes_it_drive_again(driven):
    assert not driven.feed(10.4)
    assert not any(driven.feed(10.4 + 0.05 * i) for i in range(100))
    driven.release()
    assert driven.feed(20)


def test_it_never_fires_while_the_robot_is_not_driven(driven):
    driven.release()
    assert not driven.check(1e9)
    assert driven.remaining(1e9) is None
    assert not DeadMan().check(1e9)


def test_it_says_how_long_it_waits(driven):
    assert driven.remaining(10.1) == pytest.approx(TIMEOUT - 0.1)
    assert driven.remaining(11) == 0
