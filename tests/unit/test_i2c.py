"""Each failure of the bus is one sentence that names the place and what to do."""

import errno

import pytest

from jetbot import BusError, InvalidValue, i2c
from jetbot.errors import BusStuck, NoAnswer, NotFound, PermissionDenied
from jetbot.i2c import I2CDevice, explain


@pytest.fixture(autouse=True)
def host(monkeypatch):
    monkeypatch.setattr(i2c, "bus_advice", lambda: "This computer has /dev/i2c-0.")
    monkeypatch.setattr(i2c, "permission_advice", lambda device, group: f"Join its group {group}.")


@pytest.mark.parametrize("number, kind, sentence", [
    (errno.ENOENT, NotFound, "There is no I2C bus /dev/i2c-1. This computer has /dev/i2c-0."),
    (errno.EACCES, PermissionDenied, "No permission to open /dev/i2c-1. Join its group i2c."),
    (errno.EBUSY, BusError, "0x60 on /dev/i2c-1 is in use by a kernel driver. Unload that driver."),
    (errno.ETIMEDOUT, BusStuck, "The bus /dev/i2c-1 is stuck. Switch the robot off and on, and check the wires."),
    *((number, NoAnswer, "No answer from 0x60 on /dev/i2c-1. Is the motor board plugged in and its battery on? "
       "This computer has /dev/i2c-0.") for number in (errno.ENXIO, errno.EREMOTEIO))])
def test_each_failure_has_its_class_and_sentence(number, kind, sentence):
    error = explain(OSError(number, ""), "/dev/i2c-1", 0x60)
    assert (type(error), error.errno, str(error)) == (kind, number, sentence)


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


def test_a_lasting_failure_is_reported(folder):
    device = I2CDevice(f"fake:{folder}", 0x60)
    device.read(0)
    (folder / "0x60").unlink()
    with pytest.raises(BusError) as error:
        device.read(0)
    assert str(error.value) == f"No answer from 0x60 on fake:{folder}. To plug it in: python3 -m jetbot.fake {folder}"


def test_a_fake_bus_that_cannot_be_written():
    assert str(explain(OSError(errno.EROFS, "Read-only file system"), "fake:/ro", 0x60)) == (
        "The fake bus fake:/ro cannot be used: Read-only file system. Name another folder: fake:FOLDER")
