"""A master that has ended, or is frozen, stops the robot; a slow answer does not; a restarted one drives again."""

import socket
import time
from unittest.mock import Mock

import pytest

from conftest import step_of
from jetbot import JetbotError
from jetbot_control_node.control import watch
from jetbot_control_node.control.state_machine import STOPPED, State
from jetbot_control_node.control.watch import ASK_INTERVAL, HANGING, POLL_INTERVAL, LauncherWatch, MasterWatch, repeat
from jetbot_ros.state import NO_MASTER, SUSPENDED


class Master:
    """A master that answers, or not, as ``says``: True, False for a node that it does not know, or an error."""

    def __init__(self):
        self.says = True
        self.refuses = False

    def heal(self, before_registering):
        if isinstance(self.says, Exception):
            raise self.says
        known = self.says
        if not known:
            before_registering()
            self.says = not self.refuses
        return known


@pytest.fixture
def master():
    return Master()


@pytest.fixture
def supervisor():
    """Takes holds as the Supervisor does."""
    fake = Mock(state=State(1.0), closed=False)

    def hold(which, engaged):
        fake.state = fake.state.hold(which, engaged)
    fake.hold.side_effect = hold
    return fake


@pytest.fixture
def watched(supervisor, master):
    return MasterWatch(supervisor, master.heal)


def test_a_master_that_answers_is_there(watched, supervisor):
    assert [watched.ask() for _ in range(10)] == [ASK_INTERVAL] * 10
    supervisor.hold.assert_not_called()


def test_a_master_that_refuses_twice_is_gone_and_back_at_the_first_answer(watched, supervisor, master):
    master.says = ConnectionRefusedError()
    watched.ask()
    assert supervisor.state.holds == ()
    watched.ask()
    assert supervisor.state.holds == (NO_MASTER,)
    master.says = True
    watched.ask()
    assert supervisor.state.holds == ()


def test_a_master_that_does_not_answer_in_time_is_frozen(watched, supervisor, master):
    master.says = socket.timeout()
    watched.ask()
    assert supervisor.state.holds == (NO_MASTER,)


def test_a_question_that_hangs_holds_the_robot_until_the_next_answer(watched, supervisor):
    watched.ask()
    now = time.monotonic()
    watched(step_of(STOPPED, now + HANGING - 1))
    assert supervisor.state.holds == ()
    watched(step_of(STOPPED, now + HANGING + 1))
    assert supervisor.state.holds == (NO_MASTER,)
    watched.ask()
    assert supervisor.state.holds == ()


def test_a_new_master_is_lost_until_this_node_is_registered(watched, supervisor, master):
    master.says, master.refuses = False, True
    watched.ask()
    assert supervisor.state.holds == (NO_MASTER,)
    master.refuses = False
    watched.ask()
    assert supervisor.state.holds == ()


def test_the_robot_is_held_before_it_registers_with_a_new_master(watched, supervisor, master):
    master.says = False
    watched.ask()
    assert [call.args for call in supervisor.hold.call_args_list] == [(NO_MASTER, True), (NO_MASTER, False)]


def test_a_terminal_that_is_suspended_holds_the_robot_until_it_is_resumed(supervisor):
    launcher = Mock(suspended=True, ended=False)
    watch = LauncherWatch(supervisor, launcher)
    for number in range(3):
        watch(step_of(STOPPED, number * POLL_INTERVAL))
    assert (supervisor.state.holds, supervisor.hold.call_count) == ((SUSPENDED,), 1)
    launcher.suspended = False
    watch(step_of(STOPPED, 10.0))
    watch(step_of(STOPPED, 10.0 + POLL_INTERVAL / 2))
    assert (supervisor.state.holds, launcher.poll.call_count) == ((), 4)
    supervisor.end.assert_not_called()


def test_the_end_of_roslaunch_ends_the_node(supervisor):
    LauncherWatch(supervisor, Mock(suspended=False, ended=True))(step_of(STOPPED, 0.0))
    supervisor.end.assert_called()


def test_a_watch_that_fails_ends_the_node(supervisor):
    with pytest.raises(ZeroDivisionError):
        repeat(supervisor, lambda: 1 / 0)
    supervisor.end.assert_called()
    supervisor.closed = True
    repeat(supervisor, lambda: pytest.fail("the node has ended"))


def test_what_a_user_can_fix_ends_the_node_with_its_sentence(supervisor):
    failure = JetbotError("out of file descriptors")
    watch.repeat(supervisor, Mock(side_effect=failure))
    supervisor.fail.assert_called_once_with(failure)
