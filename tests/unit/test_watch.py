"""A master that has ended, or is frozen, stops the robot; a slow answer does not; a restarted one drives again."""

import socket
import time
from unittest.mock import Mock

import pytest

from conftest import step_of
from jetbot import JetbotError
from jetbot_control_node.control import watch
from jetbot_control_node.control.state_machine import STOPPED, State
from jetbot_control_node.control.watch import (
    ASK_INTERVAL,
    HANGING,
    POLL_INTERVAL,
    RETRY_INTERVAL,
    LauncherWatch,
    MasterWatch,
    repeat,
)
from jetbot_ros.state import NO_MASTER, SUSPENDED

REFUSED, TIMEOUT = ConnectionRefusedError(), socket.timeout()
HELD, FREE = (NO_MASTER,), ()


@pytest.fixture
def supervisor():
    """Takes holds as the Supervisor does."""
    fake = Mock(state=State(1.0), closed=False)

    def hold(which, engaged):
        fake.state = fake.state.hold(which, engaged)
    fake.hold.side_effect = hold
    return fake


def watch_master(supervisor, answers):
    """Return a watch of a master that answers in turn: whether it knows this node, or with an error."""
    def heal(before_registering):
        answer = answers.pop(0)
        if isinstance(answer, Exception):
            raise answer
        if not answer:
            before_registering()
        return answer
    return MasterWatch(supervisor, heal)


@pytest.mark.parametrize("answers, holds, calls", [
    ([True] * 3, [FREE] * 3, 0),
    ([REFUSED, True, REFUSED, True], [FREE] * 4, 0),                # it was busy
    ([REFUSED, REFUSED, REFUSED, True], [FREE, HELD, HELD, FREE], 2),
    ([TIMEOUT, True], [HELD, FREE], 2),                             # it is frozen
    ([False, True], [FREE], 2),                                     # a new one: held until this node is registered
    ([False, False, False, True], [HELD, FREE], 2)], ids=str)
def test_a_master_that_is_gone_frozen_or_new_holds_the_robot(supervisor, answers, holds, calls):
    watch, seen = watch_master(supervisor, answers), []
    while answers:
        pause = watch.ask()
        seen.append(supervisor.state.holds)
        assert pause == ASK_INTERVAL or answers and pause == RETRY_INTERVAL
    assert (seen, supervisor.hold.call_count) == (holds, calls)


def test_a_question_that_hangs_holds_the_robot_until_the_next_answer(supervisor):
    watch = watch_master(supervisor, [True, True])
    watch.ask()
    now = time.monotonic()
    for later, holds in (-1, FREE), (1, HELD):
        watch(step_of(STOPPED, now + HANGING + later))
        assert supervisor.state.holds == holds
    watch.ask()
    assert supervisor.state.holds == FREE


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
