"""What the thread that drives does and when, with a clock turned by hand and no master."""

import threading
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager
from unittest.mock import Mock

import pytest

from jetbot import JetbotError
from jetbot.boards import BOARDS
from jetbot.connection import stop_board
from jetbot.fake.bus import power_on
from jetbot.fake.motors import STOPPED, wheel_speeds
from jetbot.guard.process import HEARTBEAT_TIMEOUT
from jetbot.wait import wait_until
from jetbot_control_node.control import supervisor as supervisors
from jetbot_control_node.control.state_machine import Sender
from jetbot_control_node.control.supervisor import Supervisor
from jetbot_control_node.status.notes import StatusWatch, disturbances
from jetbot_control_node.status.remarks import REMARKS
from jetbot_ros.state import EMERGENCY_STOP

PUPIL = Sender("/pupil")


@pytest.fixture
def robot(make_robot):
    return make_robot()


@pytest.fixture
def statuses():
    return []


@pytest.fixture
def supervisor(robot, statuses):
    return supervise(robot, statuses)


def supervise(robot, statuses):
    """Return a supervisor of the robot; its statuses go to the list."""
    supervisor = Supervisor(robot, 1.0)
    supervisor.watchers.append(StatusWatch(supervisor, lambda status: statuses.append(status.text)))
    return supervisor


def steps(supervisor, start, seconds):
    """Step as ``run`` would; return the moments of the steps."""
    moments, now = [], start
    while now < start + seconds:
        moments.append(now)
        due = supervisor.step(now, woken=False)
        assert due > now, "it would not sleep"
        now = due + 0.0001
    return moments


def go(supervisor):
    """Command a speed at the time 0, and drive."""
    supervisor.state = supervisor.state.command(0.4, 0.6, PUPIL, 0.0)
    supervisor.step(0.0, woken=True)


@pytest.mark.parametrize("timeout", [1.0, 0.6])  # not left to the next heartbeat
def test_no_further_command_stops_within_the_timeout(supervisor, folder, statuses, timeout):
    supervisor.state = supervisor.state._replace(timeout=timeout)
    go(supervisor)
    assert wheel_speeds(folder) == pytest.approx((0.4, 0.6), abs=0.0003)
    steps(supervisor, 0.0, timeout + 0.01)
    assert wheel_speeds(folder) == STOPPED
    assert statuses == ["driving", f"stopped: no command for {timeout} s (repeat it: rostopic pub -r 10)"]


def test_a_frozen_program_has_no_more_time_to_answer_because_this_one_stutters(supervisor, folder):
    supervisor.state = supervisor.state.command(0.4, 0.6, Sender("/pupil", latched=True), 0.0)
    for moment in range(0, 12):
        steps(supervisor, 0.9 * moment, 0.1)
    assert wheel_speeds(folder) == STOPPED


def test_a_standing_order_outlives_a_freeze_of_this_program(supervisor, folder):
    supervisor.state = supervisor.state.command(0.4, 0.6, Sender("/pupil", latched=True), 0.0)
    steps(supervisor, 0.0, 0.5)
    supervisor.step(5.0, woken=False)
    assert wheel_speeds(folder) == pytest.approx((0.4, 0.6), abs=0.0003)
    steps(supervisor, 5.05, 1.1)
    assert wheel_speeds(folder) == STOPPED


@pytest.mark.parametrize("board", ["jetbot", "sparkfun"])
@pytest.mark.parametrize("driving", [True, False])
def test_after_a_freeze_nobody_is_blamed_for_what_the_guard_has_stopped(
        make_robot, folder, statuses, board, driving):
    robot = make_robot(board=board)
    supervisor = supervise(robot, statuses)
    supervisor.state = supervisor.state.command(0.5 * driving, 0.5 * driving, PUPIL._replace(latched=True), 0.0)
    steps(supervisor, 0.0, 0.9)
    supervisor.confirm(PUPIL, 0.9)
    stop_board(BOARDS[board], f"fake:{folder}")
    steps(supervisor, 3.0, 0.9)
    assert wheel_speeds(folder, board) == pytest.approx((0.5 * driving, 0.5 * driving), abs=0.004)
    assert len(statuses) == 1
    assert set(disturbances(supervisor).values()) == {0}


def test_while_stopped_it_sleeps_but_feeds_the_guard(supervisor, robot):
    moments = steps(supervisor, 0.0, 10.0)
    assert len(moments) < 30
    assert robot._guard.heartbeat.call_count == len(moments)
    assert max(b - a for a, b in zip(moments, moments[1:])) < HEARTBEAT_TIMEOUT / 2


def test_verification_is_one_transfer_and_no_more_often_than_that_because_commands_are(supervisor, wire, robot):
    robot.driver.link.close()  # from here on, the bus counts
    go(supervisor)
    for now, woken, transfers in (0.05, False, 0), (0.0999, False, 0), (0.2, True, 1), (0.25, True, 0):
        wire.bits.clear()
        supervisor.step(now, woken)
        assert len(wire.bits) == transfers, now


def test_what_the_board_has_lost_is_restored_within_half_a_second(supervisor, folder):
    go(supervisor)
    power_on(folder)
    assert wheel_speeds(folder) == STOPPED
    steps(supervisor, 0.05, 0.45)
    assert wheel_speeds(folder) == pytest.approx((0.4, 0.6), abs=0.0003)


def test_while_driving_the_boards_own_timer_is_fed(make_robot, folder, statuses):
    robot = make_robot(board="sparkfun")
    supervisor = supervise(robot, statuses)
    supervisor.state = supervisor.state.command(0.5, 0.5, PUPIL._replace(latched=True), 0.0)
    robot.driver.keep_alive = Mock(wraps=robot.driver.keep_alive)
    moments = steps(supervisor, 0.0, 0.9)
    assert robot.driver.keep_alive.call_count == len(moments) >= 4


def test_a_board_that_does_not_answer_is_tried_again_while_the_guard_is_fed(supervisor, robot, folder, statuses):
    go(supervisor)
    for moment in (0.05, 0.5):
        (folder / "0x60").unlink()
        fed = robot._guard.heartbeat.call_count
        steps(supervisor, moment, 0.4)
        assert robot._guard.heartbeat.call_count > fed
        power_on(folder)
        steps(supervisor, moment + 0.4, 0.05)
        assert wheel_speeds(folder) == pytest.approx((0.4, 0.6), abs=0.0003)
    failed = f"stopped: no answer from 0x60 on fake:{folder}, trying again"
    assert statuses == ["driving", failed, "driving", failed,
                        "driving, its board keeps failing to answer (2 so far): check the wires"]


@contextmanager
def run(supervisor):
    """Run the supervisor in a thread of its own; give its Future once it drives or sleeps."""
    stepped = threading.Event()
    supervisor.watchers.append(lambda step: stepped.set())
    with ThreadPoolExecutor() as pool:
        running = pool.submit(supervisor.run)
        try:
            assert stepped.wait(1.0)
            yield running
        finally:
            supervisor.end()


@pytest.fixture
def running(supervisor, folder):
    """The supervisor in a thread of its own, driving, which no time-out of the command ends."""
    supervisor.state = supervisor.state._replace(timeout=60.0)
    with run(supervisor):
        supervisor.command(0.4, 0.6, PUPIL)
        assert wait_until(lambda: wheel_speeds(folder) != STOPPED, 5.0)
        yield supervisor


def test_a_command_is_driven_by_the_thread_that_brings_it(running, robot):
    threads = []
    robot.set_motors = Mock(side_effect=lambda *_: threads.append(threading.current_thread()))

    def drives_at_once():
        running.command(0.3, 0.3, PUPIL)
        return threading.current_thread() in threads
    assert wait_until(drives_at_once, 1.0)  # the first time, unless the other thread is in a step


def test_before_the_supervisor_runs_a_command_turns_no_wheel(supervisor, folder):
    supervisor.command(0.5, 0.1, PUPIL)
    assert wheel_speeds(folder) == STOPPED
    with run(supervisor):
        assert wait_until(lambda: wheel_speeds(folder) != STOPPED, 1.0)


def test_the_timeout_of_such_a_command_is_not_left_to_the_next_heartbeat(supervisor, folder, statuses, monkeypatch):
    monkeypatch.setattr(supervisors, "STOPPED_INTERVAL", 30.0)
    supervisor.state = supervisor.state._replace(timeout=0.1)
    with run(supervisor):
        supervisor.command(0.4, 0.6, PUPIL)
        assert wait_until(lambda: "no command for" in statuses[-1] and wheel_speeds(folder) == STOPPED, 5.0)


def test_what_fails_in_the_thread_of_a_command_ends_the_other_one_with_the_wheels_stopped(supervisor, robot, folder):
    with run(supervisor) as running:
        robot.set_motors = Mock(side_effect=[JetbotError("out of file descriptors"), *[None] * 100])
        supervisor.command(0.4, 0.6, PUPIL)
        assert isinstance(running.exception(5.0), JetbotError)
    assert wheel_speeds(folder) == STOPPED


def test_an_emergency_stop_wakes_the_thread_and_lasts(running, folder):
    running.hold(EMERGENCY_STOP, True)
    assert wait_until(lambda: wheel_speeds(folder) == STOPPED, 5.0)
    running.command(0.4, 0.6, PUPIL)
    assert not wait_until(lambda: wheel_speeds(folder) != STOPPED, 0.2)
    running.end()
    assert wait_until(lambda: running.closed, 5.0)


def test_a_stop_overtakes_thirty_programs_on_a_slow_bus(supervisor, folder):
    (folder / "clock").write_text("100000")
    supervisor.robot.driver.link.close()  # the bus reads its clock when it is opened
    running = threading.Thread(target=supervisor.run)
    programs = [threading.Thread(target=command_often, args=[supervisor, 0.3 + i / 100]) for i in range(30)]
    for thread in (running, *programs):
        thread.start()
    assert wait_until(lambda: wheel_speeds(folder) != STOPPED, 1.0)
    supervisor.hold(EMERGENCY_STOP, True)
    assert wait_until(lambda: wheel_speeds(folder) == STOPPED, 0.2)
    assert not wait_until(lambda: wheel_speeds(folder) != STOPPED, 0.3)
    supervisor.end()
    for thread in (running, *programs):
        thread.join()


def command_often(supervisor, speed):
    """Command this speed thirty times per second until the supervisor ends."""
    while not wait_until(lambda: supervisor.closed, 1 / 30, interval=1 / 30):
        supervisor.command(speed - 0.1, speed + 0.1, PUPIL)


def test_without_a_guard_nothing_turns(supervisor, robot, folder, statuses, monkeypatch):
    go(supervisor)
    monkeypatch.setattr(type(robot), "guarded", False)
    supervisor.step(0.1, woken=False)
    assert wheel_speeds(folder) == STOPPED
    assert statuses == ["driving", "stopped: the guard, which stops the wheels if this program dies, is not running, "
                        "trying again"]


@pytest.mark.parametrize("fail", [
    lambda supervisor, error: setattr(supervisor.robot, "verify", Mock(side_effect=error)), Supervisor.fail],
    ids=["its own thread", "another thread"])
def test_what_cannot_be_retried_ends_the_thread_with_the_wheels_stopped(supervisor, folder, fail):
    go(supervisor)
    fail(supervisor, JetbotError("out of file descriptors"))
    with pytest.raises(JetbotError, match="Out of file descriptors"):
        supervisor.run()
    assert wheel_speeds(folder) == STOPPED


@pytest.mark.parametrize("max_duty, limit", [(1, "full power"), (0.5, "max_duty")])
def test_a_turn_that_is_cut_off_is_reported(supervisor, robot, statuses, monkeypatch, max_duty, limit):
    monkeypatch.setattr(type(robot), "at_full_power", True)
    robot.left_motor.max_duty = max_duty
    go(supervisor)
    assert statuses == [f"driving, both wheels at {limit}"]


def test_a_command_below_the_steps_of_the_board_is_reported_unless_it_passes(supervisor, folder, statuses):
    supervisor.state = supervisor.state.command(0.0001, 0.0001, PUPIL, 0.0)
    steps(supervisor, 0.0, 0.4)
    assert statuses == ["driving"]
    steps(supervisor, 0.4, 0.4)
    assert wheel_speeds(folder) == STOPPED
    assert statuses[-1] == f"driving, {REMARKS['too_slow']}"
    supervisor.state = supervisor.state.command(0.01, 0.01, PUPIL, 0.8)
    steps(supervisor, 0.8, 0.3)
    supervisor.state = supervisor.state.command(0.0, 0.0, PUPIL, 1.1)
    steps(supervisor, 1.1, 2.0)
    assert statuses[2:] == ["driving", "stopped: the command is zero"]


def test_a_program_whose_command_arrives_after_its_end_is_not_listed(supervisor):
    order = Sender("/order", latched=True, number=1)
    supervisor.disconnect(order, others=True)
    supervisor.command(0.5, 0.5, order)
    assert supervisor.commands.recent(0.0) == []


@pytest.mark.parametrize("timeout", [1.0, 0.0])
@pytest.mark.parametrize("first", ["a command", "a step"])
def test_what_was_commanded_during_a_freeze_of_this_program_moves_nothing(
        supervisor, folder, monkeypatch, timeout, first):
    supervisor.state = supervisor.state._replace(timeout=timeout)
    clock = Mock(return_value=0.0)
    monkeypatch.setattr(supervisors.time, "monotonic", clock)
    supervisor.step(0.0, woken=False)
    clock.return_value = 3.0
    if first == "a step":
        supervisor.step(3.0, woken=False)
    supervisor.command(-0.9, -0.9, PUPIL)
    supervisor.step(3.0, woken=True)
    assert wheel_speeds(folder) == STOPPED
    clock.return_value = 3.0 + supervisors.STALE_FOR
    supervisor.command(0.5, 0.5, PUPIL)
    supervisor.step(clock(), woken=True)
    assert wheel_speeds(folder) == pytest.approx((0.5, 0.5), abs=0.0003)
