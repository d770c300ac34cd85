"""Each failure of the bus is one sentence that names the place and what to do."""

import errno
import resource
import time

import pytest

from jetbot import BusError, InvalidValue, i2c
from jetbot.boards import find_board
from jetbot.connection import open_board
from jetbot.errors import BusStuck, FatalError, NoAnswer
from jetbot.fake.bus import FakeBus
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import I2CDevice, explain


@pytest.fixture(autouse=True)
def host(monkeypatch):
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: "")
    monkeypatch.setattr(i2c, "bus_advice", lambda: "This computer has /dev/i2c-0.")
    monkeypatch.setattr(i2c, "permission_advice", lambda device, group: f"Join its group {group}.")


FAKE = 'Without a robot, use Robot(i2c_bus="fake"), or type first: export JETBOT_I2C_BUS=fake'


@pytest.mark.parametrize("number, kind, sentence", [
    (errno.ENOENT, BusError, "There is no I2C bus /dev/i2c-1. This computer has /dev/i2c-0. " + FAKE),
    (errno.EACCES, BusError, "No permission to open /dev/i2c-1. Join its group i2c."),
    (errno.EBUSY, BusError, "0x60 on /dev/i2c-1 is in use by a kernel driver. Unload that driver."),
    (errno.ETIMEDOUT, BusStuck, "The bus /dev/i2c-1 is stuck. Switch the robot off and on, and check the wires."),
    *((number, NoAnswer, "No answer from 0x60 on /dev/i2c-1. Is the motor board plugged in and its battery on? "
       "This computer has /dev/i2c-0. " + FAKE) for number in (errno.ENXIO, errno.EREMOTEIO, errno.EAGAIN))])
def test_each_failure_has_its_class_and_sentence(number, kind, sentence):
    error = explain(OSError(number, ""), "/dev/i2c-1", 0x60)
    assert (type(error), error.errno, str(error)) == (kind, number, sentence)


@pytest.mark.parametrize("driver, kind, sentence", [
    ("ina3221", NoAnswer, "0x40 on /dev/i2c-1 is in use by the kernel driver ina3221. That chip measures the supply, "
                          "and drives no motor. This computer has /dev/i2c-0."),
    ("pca9685-pwm", BusError, "0x40 on /dev/i2c-1 is in use by the kernel driver pca9685-pwm. If it is the motor "
                              "board, release it: echo 1-0040 | sudo tee /sys/bus/i2c/drivers/pca9685-pwm/unbind")])
def test_a_chip_that_a_kernel_driver_holds(monkeypatch, driver, kind, sentence):
    monkeypatch.setattr(i2c, "kernel_driver", {"1-0040": driver}.__getitem__)
    error = explain(OSError(errno.EBUSY, ""), "/dev/i2c-1", 0x40)
    assert (type(error), error.errno, str(error)) == (kind, errno.EBUSY, sentence)


@pytest.mark.parametrize("bus", ["", "one", "fake:", "-1", 1.5, None])
def test_a_bad_bus(bus):
    with pytest.raises(InvalidValue, match="^An I2C bus cannot be .*. Give a number"):
        I2CDevice(bus, 0x60)


def test_one_failed_transfer_is_repeated(folder):
    device = I2CDevice(f"fake:{folder}", 0x60)
    device.read(0)
    (folder / "0x60.fail").write_text("1")
    assert device.read(0) == 0x11
    assert device.errors == 1


@pytest.mark.parametrize("address, advice", [
    (0x60, "To plug it in: python3 -m jetbot.fake {}"),
    (0x6A, "To plug it in: python3 -m jetbot.fake {} --i2c-address 0x6a"),
    (61, "Do you mean 0x61? A fake motor board is at 0x40 to 0x77.")])
def test_a_fake_board_that_is_missing_is_named_with_what_plugs_it_in(folder, address, advice):
    device = I2CDevice(f"fake:{folder}", address)
    I2CDevice(f"fake:{folder}", 0x60).read(0)
    (folder / "0x60").unlink()
    with pytest.raises(BusError) as error:
        device.read(0)
    assert str(error.value) == f"No answer from 0x{address:02x} on fake:{folder}. {advice.format(folder)}"


def test_a_fake_bus_that_cannot_be_written():
    assert str(explain(OSError(errno.EROFS, "Read-only file system"), "fake:/ro", 0x60)) == (
        "The fake bus fake:/ro cannot be used: Read-only file system. Name another folder: fake:FOLDER")


def test_a_program_without_a_file_descriptor_left(folder):
    device = I2CDevice(f"fake:{folder}", 0x60)
    device.read(0)
    limits = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (3, limits[1]))
    try:
        with pytest.raises(FatalError, match="^Out of file descriptors or memory: Too many open files."):
            device.read(0)
    finally:
        resource.setrlimit(resource.RLIMIT_NOFILE, limits)
    assert device.read(0) == 0x11


@pytest.fixture
def slow(monkeypatch):
    """Lets transfers take the seconds in a list, which is used up; none left: no time."""
    durations, now = [], [0.0]

    def transfer(bus, *arguments):
        now[0] += durations.pop(0) if durations else 0.0
        return transfer_at_once(bus, *arguments)

    transfer_at_once = FakeBus._transfer
    monkeypatch.setattr(FakeBus, "_transfer", transfer)
    monkeypatch.setattr(time, "monotonic", lambda: now[0])
    return durations


def test_the_second_slow_transfer_in_a_row_ends_the_program_once_but_not_while_it_starts(folder, slow):
    slow += [0.2] * 100
    board = open_board(find_board("adafruit"), f"fake:{folder}")
    slow.clear()
    board.drive(1, 1)
    slow += [0.2, 0.01] * 10
    for _ in range(20):
        board.verify()  # one now and then is accepted
    slow[:] = [0.2] * 100
    board.verify()
    with pytest.raises(FatalError, match="^The bus fake:.* is too slow to stop the robot in time: 0.20 s a transfer."):
        board.verify()
    board.drive(0, 0)
    assert wheel_speeds(folder) == (0, 0)
    assert 100 - len(slow) < 15
