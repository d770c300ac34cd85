"""The fake chips follow their data sheets, also for a driver that is wrong; the motors follow their chip at once."""

import os
import runpy
import sys
import time
from pathlib import Path

import pytest

from conftest import registers
from jetbot import BusError, Robot
from jetbot.fake import motors as module
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.chips import PCA9685
from jetbot.fake.motors import CLOCK_TICK, STOPPED, Motors, wheel_speeds
from jetbot.fake.port import FakePort
from jetbot.wait import wait_until

VOLTS = [0x5E, 0x8A]
FULL, HALF, OFF = bytes([0, 0x10, 0, 0]), bytes([0, 0, 0, 0x08]), bytes([0, 0, 0, 0x10])  # one output's registers


@pytest.fixture
def bus(folder):
    return FakeBus(folder)


def test_a_motor_board_takes_the_place_of_the_sensor_which_moves_to_its_other_address(six_boards, bus, folder):
    assert bus.read_i2c_block_data(0x41, 0x02, 2) == VOLTS
    power_on(folder, 0x41)
    for _ in range(2):
        assert bus.read_byte_data(0x41, 0xFE) == 0x1E
        assert bus.read_i2c_block_data(0x42, 0x02, 2) == VOLTS
        power_on(folder)
    (folder / "0x41").unlink()
    FakeBus(folder)
    assert not (folder / "0x41").exists(), "what is unplugged stays unplugged"
    power_on(folder)
    assert bus.read_i2c_block_data(0x41, 0x02, 2) == VOLTS


def test_a_chip_is_known_by_its_name_whatever_its_address(folder):
    for _ in range(2):
        with Robot("sparkfun", f"fake:{folder}", i2c_address=0x58, guard=False) as robot:
            robot.set_motors(0.5, -0.5)
            assert wheel_speeds(folder, "sparkfun", 0x58) == (0.5, -0.5)
            other = Motors(folder, "waveshare_hat", 0x58)
            assert (other.speeds(), other.pwm_frequency()) == (STOPPED, None)
        power_on(folder)
    assert registers(folder, 0x58)[-16:] == b"SCMD".ljust(16, b"\0")


@pytest.mark.usefixtures("six_boards")
@pytest.mark.parametrize("board, address, found, option", [
    ("waveshare", 0x41, "INA219, not as PCA9685", ""),
    ("sparkfun", 0x60, "PCA9685, not as SCMD", " --chip SCMD")])
def test_another_chip_than_the_boards_is_named_and_what_to_do(folder, monkeypatch, board, address, found, option):
    monkeypatch.delenv("MORBOT", raising=False)
    power_on(folder)
    with pytest.raises(BusError) as error:
        Robot(board, f"fake:{folder}", i2c_address=address, guard=False)
    command = f"python3 -m jetbot.fake {folder} --i2c-address 0x{address:02x}{option}"
    assert str(error.value) == (f"The chip at 0x{address:02x} on fake:{folder} is simulated as {found}. "
                                f"To plug that in: {command}")
    power_on_by_hand(monkeypatch, *command.split()[3:])
    Robot(board, f"fake:{folder}", i2c_address=address, guard=False).close()


def test_of_two_that_make_a_folder_the_first_wins(folder, monkeypatch):
    def write_late(file, content, write=Path.write_bytes):
        monkeypatch.setattr(Path, "write_bytes", write)
        FakeBus(folder).write_byte_data(0x60, 0x06, 1)
        return write(file, content)

    monkeypatch.setattr(Path, "write_bytes", write_late)
    assert FakeBus(folder).read_byte_data(0x60, 0x06) == 1
    assert os.listdir(folder.parent) == [folder.name]


@pytest.mark.parametrize("left", [["jetbot_01/"], ["0x41.4242"], ["0x41", "0x60.4242"]],
                         ids=["the buses of namespaces", "half a chip", "half a folder"])
def test_a_folder_without_chips_gets_them(folder, left):
    for name in left:
        (folder / name).mkdir(parents=True) if name.endswith("/") else folder.mkdir(exist_ok=True)
        (folder / name).touch()
    assert FakeBus(folder).read_byte_data(0x60, 0xFE) == 0x1E


@pytest.mark.parametrize("mode1, register, written, held", [
    (0x10, 0x06, [1, 2, 3], "03000010"), (0x30, 0x06, [1, 2, 3], "01020310"),  # auto-increment
    (0x00, 0xFE, [3], "1e"), (0x10, 0xFE, [3], "03")])                             # asleep
def test_a_block_fills_registers_with_auto_increment_and_pre_scale_is_written_asleep(
        bus, folder, mode1, register, written, held):
    bus.write_byte_data(0x60, 0x00, mode1)
    bus.write_i2c_block_data(0x60, register, written)
    assert registers(folder)[register:].hex().startswith(held)
    read = bus.read_i2c_block_data(0x60, register, 3)
    assert mode1 & 0x20 or read == [registers(folder)[register]] * 3


@pytest.mark.parametrize("backward, forward, speed", [
    (OFF, HALF, 0.5), (HALF, OFF, -0.5), (OFF, OFF, 0.0), (FULL, FULL, 0.0), (HALF, FULL, 0.0), (FULL, HALF, 0.0)])
def test_a_motor_with_both_inputs_high_gets_no_power(bus, folder, backward, forward, speed):
    bus.write_byte_data(0x60, 0x00, 0x20)
    bus.write_i2c_block_data(0x60, 0x06, list(backward + forward))
    assert wheel_speeds(folder, "waveshare") == (speed, 0.0)


@pytest.mark.parametrize("meanwhile", [lambda folder: (folder / "0x60").unlink(), power_on])
def test_what_happens_in_mid_transfer_leaves_the_chip_without_a_stop(folder, monkeypatch, meanwhile):
    power_on(folder)
    (folder / "clock").write_text("100000")
    bus = FakeBus(folder)
    monkeypatch.setattr(time, "sleep", lambda seconds: meanwhile(folder))
    with pytest.raises(OSError, match="Remote I/O error"):
        bus.write_byte_data(0x60, 0x00, 0x20)
    assert wheel_speeds(folder) == STOPPED


@pytest.mark.parametrize("size", [0, 255, 257])
def test_a_file_that_is_no_chip(bus, folder, size):
    for name in ("0x60", "0x5d", "jetbot_pro"):
        (folder / name).write_bytes(bytes(size))
    for use in (lambda: bus.read_byte_data(0x60, 0), lambda: bus.write_byte_data(0x5D, 0x20, 0),
                lambda: FakePort(folder, 1.0).read(1), lambda: FakePort(folder, 1.0).write(bytes(11))):
        with pytest.raises(BusError, match="^/.* is not a chip, which is a file of .* bytes. Make a new one: python3 "):
            use()
    assert wheel_speeds(folder) == wheel_speeds(folder, "sparkfun") == wheel_speeds(folder, "jetbot_pro") == STOPPED


def test_two_processes_write_one_chip_at_once(bus, folder):
    writer = os.fork()
    if not writer:
        try:
            count_in(FakeBus(folder), 0x0A)
            os._exit(0)
        finally:
            os._exit(1)
    count_in(bus, 0x0E)
    assert os.waitpid(writer, 0)[1] == 0


def count_in(bus, register):
    """Count in a register; fail if it loses a step."""
    for count in range(1000):
        bus.write_byte_data(0x60, register, count % 256)
        assert bus.read_byte_data(0x60, register) == count % 256


def test_a_byte_that_another_writes_in_mid_transfer_stays(bus, folder, monkeypatch):
    def interrupted(registers, register, data):
        monkeypatch.undo()
        FakeBus(folder).write_byte_data(0x60, 0x0A, 7)
        PCA9685.write(registers, register, data)

    monkeypatch.setattr(PCA9685, "write", interrupted)
    bus.write_byte_data(0x60, 0x0E, 9)
    assert (registers(folder)[0x0A], registers(folder)[0x0E]) == (7, 9)


@pytest.mark.parametrize("text", ["", "fast", "0", "-1", "nan", "inf"])
def test_a_clock_that_cannot_be(folder, text):
    power_on(folder)
    (folder / "clock").write_text(text)
    with pytest.raises(BusError, match="clock must hold the clock of the bus in Hz, 10 to 10000000. Write"):
        FakeBus(folder)


@pytest.mark.parametrize("plug_in", [FakeBus, power_on])
@pytest.mark.parametrize("address, possible", [(0x3D, False), (0x3F, False), (0x40, True), (0x77, True)])
def test_a_chip_has_the_address_of_a_pca9685(folder, plug_in, address, possible):
    plug_in(folder, address)
    assert (folder / f"0x{address:02x}").exists() == possible


def power_on_by_hand(monkeypatch, *words):
    monkeypatch.setattr(sys, "argv", ["jetbot.fake", *map(str, words)])
    runpy.run_module("jetbot.fake", run_name="__main__")


@pytest.mark.parametrize("chip, addresses, possible", [
    ("PCA9685", ["0x3f", "0x78", "0x161", "sixty"], "0x40 to 0x77"), ("SCMD", ["0x57", "0x64"], "0x58 to 0x63")])
def test_no_chip_can_be_at_any_address(folder, monkeypatch, capsys, chip, addresses, possible):
    for address in addresses:
        with pytest.raises(SystemExit):
            power_on_by_hand(monkeypatch, folder, "--i2c-address", address, "--chip", chip)
        assert f"--i2c-address must be an address from {possible}" in capsys.readouterr().err


@pytest.mark.parametrize("restart, duty", [(0x20, 0), (0xA0, 0.5)])
def test_an_output_that_was_on_before_a_sleep_goes_on_after_a_restart(bus, folder, restart, duty):
    bus.write_byte_data(0x60, 0x00, 0x20)
    bus.write_i2c_block_data(0x60, 0x06, list(HALF))
    for mode1 in (0x30, 0x20, restart):
        bus.write_byte_data(0x60, 0x00, mode1)
    assert PCA9685.duty(registers(folder), 0) == duty


@pytest.mark.parametrize("name", ["/dev/null", "/dev/null/\x1b[2J"])
def test_a_folder_that_cannot_be_made_gets_one_sentence(monkeypatch, name):
    with pytest.raises(SystemExit) as end:
        power_on_by_hand(monkeypatch, name)
    assert end.value.code.startswith("The fake bus /dev/null") and end.value.code.isprintable()


@pytest.fixture
def robot(folder):
    with Robot("adafruit", f"fake:{folder}", guard=False) as robot:
        yield robot


@pytest.fixture
def motors(robot, folder):
    return Motors(folder)


def age(file):
    """Let a file be older than the clock's tick."""
    os.utime(file, (time.time() - 2 * CLOCK_TICK,) * 2)


def near(speed):
    return pytest.approx((speed, speed), abs=0.0003)


def test_a_file_that_has_not_changed_is_read_once(motors, folder, monkeypatch):
    reads = []
    read_chip = module.read_chip
    monkeypatch.setattr(module, "read_chip", lambda *arguments: reads.append(arguments) or read_chip(*arguments))
    age(folder / "0x60")
    for _ in range(10):
        assert motors.speeds() == STOPPED
    assert len(reads) == 1


def test_the_second_of_two_writes_within_a_tick_of_the_clock_counts(motors, robot, folder):
    robot.forward(0.5)
    written = os.stat(folder / "0x60").st_mtime_ns
    assert motors.speeds() == near(0.5)
    robot.stop()
    os.utime(folder / "0x60", ns=(written, written))
    assert motors.speeds() == STOPPED


def test_a_chip_that_is_unplugged_turns_no_wheel_until_it_is_back(motors, robot, folder):
    robot.forward(0.5)
    age(folder / "0x60")
    assert motors.speeds() == near(0.5)
    os.rename(folder / "0x60", folder / "unplugged")
    assert (motors.speeds(), motors.pwm_frequency()) == (STOPPED, None)
    os.rename(folder / "unplugged", folder / "0x60")
    assert motors.speeds() == near(0.5)
    power_on(folder)
    assert motors.speeds() == STOPPED


def test_the_timer_of_a_chip_that_is_not_fed_runs_off_while_its_file_does_not_change(folder):
    with Robot("sparkfun", f"fake:{folder}", guard=False) as robot:
        robot.forward(0.5)
        robot.keep_alive()  # arms the timer
        motors = Motors(folder, "sparkfun")
        assert motors.speeds() == pytest.approx((0.5, 0.5), abs=0.01)
        assert wait_until(lambda: motors.speeds() == STOPPED, 5.0)
