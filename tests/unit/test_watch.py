"""A master that has ended, or is frozen, stops the robot; a slow answer does not; a restarted one drives again."""

import time
from unittest.mock import Mock

import pytest

from jetbot import JetbotError
from jetbot_control_node.control import watch
from jetbot_control_node.control.state import State
from jetbot_control_node.control.watch import ASK_INTERVAL, POLL_INTERVAL, MasterWatch, check, repeat
from jetbot_ros.holds import NO_MASTER, SUSPENDED


class Master:
    """A master that answers, or not, as ``says``: True, False for a node that it does not know, or an error."""

    def __init__(self):
        self.says = True
        self.refuses = False

    def heal(self):
        if isinstance(self.says, Exception):
            raise self.says
        known, self.says = self.says, not self.refuses
        return known


@pytest.fixture
def master():
    return Master()


@pytest.fixture
def asked(master):
    return MasterWatch(master.heal)


def polls(asked, seconds):
    """Poll for so long; return the last result."""
    return [asked.poll() for _ in range(round(seconds / POLL_INTERVAL))][-1]


def test_a_master_that_answers_each_second_is_there(asked):
    for _ in range(10):
        assert asked.ask() == ASK_INTERVAL
        assert not polls(asked, ASK_INTERVAL)


def test_a_master_that_refuses_twice_is_gone_and_back_at_the_first_answer(asked, master):
    master.says = ConnectionRefusedError()
    asked.ask()
    assert not asked.poll()
    asked.ask()
    assert asked.poll()
    master.says = True
    asked.ask()
    assert not asked.poll()


def test_a_frozen_master_is_gone_within_two_and_a_half_seconds_and_a_slow_one_is_not(asked):
    asked.ask()
    asked.poll()
    assert not polls(asked, 2.0)
    assert polls(asked, 0.5)


def test_a_new_master_is_lost_until_this_node_is_registered(asked, master):
    asked.ask()
    master.says, master.refuses = False, True
    asked.ask()
    assert asked.poll()
    master.refuses = False
    asked.ask()
    assert not asked.poll()


def test_a_command_counts_as_soon_as_the_master_is_back(asked, master):
    master.says = ConnectionRefusedError()
    asked.ask()
    master.says = False
    asked.ask()
    started = time.monotonic()
    asked.wait(60.0)
    assert not asked.poll() and time.monotonic() < started + 30.0


@pytest.fixture
def supervisor():
    """Takes holds as the Supervisor does."""
    fake = Mock(state=State(1.0), closed=False)

    def hold(which, engaged):
        fake.state = fake.state.hold(which, engaged)
    fake.hold.side_effect = hold
    return fake


def test_holds_are_engaged_and_released_once(supervisor, asked, master):
    launcher = Mock(suspended=True, ended=False)
    master.says = ConnectionRefusedError()
    asked.ask(), asked.ask()
    for _ in range(3):
        check(supervisor, launcher, asked)
    assert supervisor.state.holds == (NO_MASTER, SUSPENDED)
    assert supervisor.hold.call_count == 2
    launcher.suspended, master.says = False, True
    asked.ask()
    for _ in range(3):
        check(supervisor, launcher, asked)
    assert supervisor.state.holds == ()
    supervisor.end.assert_not_called()


def test_the_end_of_roslaunch_ends_the_node(supervisor, asked):
    check(supervisor, Mock(suspended=False, ended=True), asked)
    supervisor.end.assert_called()


def test_a_watch_that_fails_ends_the_node(supervisor):
    with pytest.raises(ZeroDivisionError):
        watch.repeat(supervisor, lambda: 1 / 0)
    supervisor.end.assert_called()
    supervisor.closed = True
    repeat(supervisor, lambda: pytest.fail("the node has ended"))


def test_what_a_user_can_fix_ends_the_node_with_its_sentence(supervisor):
    failure = JetbotError("out of file descriptors")
    watch.repeat(supervisor, Mock(side_effect=failure))
    supervisor.fail.assert_called_once_with(failure)
