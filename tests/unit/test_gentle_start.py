"""What reaches the board while the wheels speed up within acceleration_limit, with a clock turned by hand."""

import pytest

from conftest import registers
from jetbot.boards import BOARDS
from jetbot.fake.bus import power_on
from jetbot.fake.chips import chip_class
from jetbot.fake.motors import STOPPED
from jetbot_control_node.control.ramp import MAX_STEP, Ramp
from jetbot_control_node.control.state_machine import Sender
from jetbot_control_node.control.supervisor import Supervisor
from jetbot_ros.state import EMERGENCY_STOP, SUSPENDED

PUPIL = Sender("/pupil", latched=True)
RESOLUTION = 1 / 128  # of the coarsest board, SparkFun's
SLOW = 0.005          # s that a computer is late


class Drive:
    """A supervisor with a limit of 1 m/s^2 and a robot on the fake bus, whose wheels are recorded."""

    def __init__(self, robot, folder, board, wire):
        self.robot, self.board, self.folder, self.wire, self.now = robot, BOARDS[board], folder, wire, 0.0
        self.file, self.stopped = f"0x{self.board.address:02x}", self.registers()
        self.supervisor = Supervisor(robot, 1.0, Ramp(1.0))
        self.supervisor.step(0.0, woken=False)

    def command(self, left, right):
        self.supervisor.state = self.supervisor.state.command(left, right, PUPIL, self.now)

    def step(self, elapsed=0.001):
        """Step after this time; return the pause until the next step."""
        self.now += elapsed
        self.supervisor.confirm(PUPIL, self.now)
        return self.supervisor.step(self.now, woken=False) - self.now

    def run(self, seconds):
        """Step for some time as its thread would on a slow computer; return the pauses between the steps."""
        end, pauses = self.now + seconds, [0.0]
        while self.now < end:
            pauses.append(self.step(pauses[-1] + SLOW) + SLOW)
        return pauses[1:]

    def drive_at(self, speed):
        """Drive until the wheels have this speed."""
        self.command(speed, speed)
        self.run(1.0)

    def registers(self):
        return registers(self.folder, self.board.address)

    def note(self):
        """Record the wheels at a moment without a transfer."""
        self.wire.states.append(self.registers())

    def speeds(self):
        """Return the speeds (left, right) of the wheels after each transfer."""
        speed = chip_class(self.board.chip).speed
        return [tuple(speed(state, wheel, 0.0) for wheel in (self.board.left, self.board.right))
                for state in self.wire.states]

    def assert_gentle(self, first=STOPPED):
        """Fail if a wheel has ever become faster, from its first speed on, by more than MAX_STEP allows."""
        speeds = [first, *self.speeds()]
        for before, after in zip(speeds, speeds[1:]):
            grown = (abs(speed) - (abs(was) if speed * was > 0 else 0) for was, speed in zip(before, after))
            assert max(grown) <= MAX_STEP + RESOLUTION, (before, after)


@pytest.fixture(params=["adafruit", "waveshare", "sparkfun"])
def drive(request, make_robot, folder, wire):
    return Drive(make_robot(board=request.param), folder, request.param, wire)


def near(*speeds):
    return pytest.approx(speeds, abs=RESOLUTION)


def test_the_wheels_speed_up_on_the_arc_that_is_commanded_in_steps_of_20_ms_at_most(drive):
    drive.command(0.2, 0.6)
    assert max(drive.run(0.5)) <= 0.02
    assert drive.speeds()[-1] != near(0.2, 0.6)
    drive.run(0.3)
    assert drive.speeds()[-1] == near(0.2, 0.6)
    drive.assert_gentle()
    assert drive.robot.duties == pytest.approx((0.2, 0.6))


def test_once_the_speed_is_reached_nothing_is_sent_and_the_steps_are_as_rare_as_without_a_ramp(drive, monkeypatch):
    drive.drive_at(0.5)
    monkeypatch.setattr(drive.robot, "verify", lambda: None)
    monkeypatch.setattr(drive.robot, "keep_alive", lambda: None)
    drive.wire.bits.clear()
    assert len(drive.run(1.0)) < 10
    assert drive.wire.bits == []


@pytest.mark.parametrize("stop", [
    lambda drive: drive.command(0.0, 0.0), lambda drive: drive.command(0.5, float("nan")),
    lambda drive: drive.supervisor.hold(EMERGENCY_STOP, True), lambda drive: drive.supervisor.disconnect(PUPIL, False)],
    ids=["zero", "not finite", "emergency stop", "nobody is left"])
def test_a_stop_is_obeyed_in_one_step_in_the_middle_of_a_ramp(drive, stop):
    drive.command(0.5, 0.5)
    drive.run(0.2)
    stop(drive)
    drive.step()
    assert drive.speeds()[-1] == STOPPED


def brown_out(drive):
    power_on(drive.folder)
    drive.note()


def unplugged_for_a_while(drive):
    (drive.folder / drive.file).rename(drive.folder / "unplugged")
    drive.run(0.3)
    power_on(drive.folder)
    drive.note()


def guard_lost_for_a_while(drive):
    drive.robot._guard.is_up.return_value = False
    drive.run(0.3)
    drive.robot._guard.is_up.return_value = True


def frozen_so_that_the_guard_stops_the_wheels(drive):
    drive.now += 0.7
    (drive.folder / drive.file).write_bytes(drive.stopped)
    drive.note()


def suspended(drive):
    for engaged in (True, False):
        drive.supervisor.hold(SUSPENDED, engaged)
        drive.step()
    drive.command(0.5, 0.5)


def failing(transfers):
    def fail(drive):
        (drive.folder / f"{drive.file}.fail").write_text(str(transfers))
    return fail


@pytest.mark.parametrize("seconds", [0.2, 1.0], ids=["in the middle of a ramp", "at full speed"])
@pytest.mark.parametrize("event", [
    brown_out, unplugged_for_a_while, guard_lost_for_a_while, frozen_so_that_the_guard_stops_the_wheels, suspended,
    *map(failing, (1, 3, 6))], ids=lambda event: event.__name__)
def test_wheels_that_something_else_has_stopped_speed_up_again_from_zero(drive, event, seconds):
    drive.command(0.5, 0.5)
    drive.run(seconds)
    drive.wire.states.clear()
    drive.note()
    event(drive)
    drive.run(2.0)
    assert STOPPED in drive.speeds() or event.__name__ == "fail"
    assert drive.speeds()[-1] == near(0.5, 0.5)
    drive.assert_gentle(drive.speeds()[0])
