"""A Robot that threads and signal handlers use at the same moment."""

import itertools
import re
import sys
import threading

import pytest

from jetbot import Robot
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import I2CDevice


def test_many_threads(make_robot, folder):
    robot = make_robot()
    threads = [threading.Thread(target=lambda: [robot.set_motors(i / 200, -i / 200) for i in range(-100, 101)])
               for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert wheel_speeds(folder) == pytest.approx((robot.left_motor.value, robot.right_motor.value), abs=0.0003)


@pytest.mark.parametrize("second", [Robot.forward, Robot.verify])
@pytest.mark.parametrize("first", [Robot.forward, Robot.verify])
def test_a_thread_waits_while_another_one_uses_the_board(make_robot, monkeypatch, first, second):
    robot = make_robot()
    other = threading.Thread(target=second, args=[robot])
    users = []

    def watch(method):
        def use(*args):
            users.append(threading.current_thread())
            if len(users) == 1:
                other.start()
                other.join(0.5)  # unless it waits
                assert users == [threading.current_thread()]
            return method(*args)
        return use
    for name in "drive", "verify":
        monkeypatch.setattr(robot.driver, name, watch(getattr(robot.driver, name)))
    first(robot)
    other.join()


def test_a_signal_handler_may_close_it_during_a_transfer(make_robot, folder, monkeypatch):
    robot = make_robot()
    write = I2CDevice.write

    def interrupted(link, register, data):
        monkeypatch.setattr(I2CDevice, "write", write)
        robot.close()
        write(link, register, data)

    robot.forward(0.3)
    monkeypatch.setattr(I2CDevice, "write", interrupted)
    robot.forward(0.5)
    assert wheel_speeds(folder) == wheel_speeds(folder, "waveshare") == (0, 0)


def stops_at(robot, line):
    """Drive, and stop before this line of the driver is run; return whether there was such a line."""
    lines = itertools.count(1)

    def trace(frame, *_):
        if not re.match(r"jetbot\.(?!fake)", frame.f_globals["__name__"]):
            return None  # on a real robot, a transfer is the kernel's
        if next(lines) == line:
            sys.settrace(None)
            robot.stop()
        return trace

    sys.settrace(trace)
    try:
        robot.forward(0.5)
    finally:
        sys.settrace(None)
    return next(lines) > line


def test_a_signal_handler_may_stop_it_at_any_line(make_robot, folder):
    robot = make_robot()
    line = 1
    while stops_at(robot, line):
        assert wheel_speeds(folder) == wheel_speeds(folder, "waveshare"), f"stopped at line {line}"
        assert wheel_speeds(folder) in ((0, 0), (0.5, 0.5)), f"stopped at line {line}"
        robot.stop()
        line += 1
    assert line > 20
