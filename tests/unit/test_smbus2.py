"""The real path: smbus2 itself runs, and what it asks of the kernel arrives at the fake chip."""

import errno
import os
from types import SimpleNamespace

import pytest

from jetbot import BusError, i2c
from jetbot.fake.bus import FakeBus, power_on
from jetbot.fake.motors import wheel_speeds
from jetbot_tools.doctor import motor_board

smbus2 = pytest.importorskip("smbus2.smbus2")

KERNEL_FD = 4711


class Kernel:
    """/dev/i2c-1 as seen through open and ioctl, with the fake bus behind it."""

    def __init__(self, folder):
        self.bus = FakeBus(folder)
        self.address = None

    def open(self, path, flags):
        assert path == "/dev/i2c-1"
        return KERNEL_FD

    def close(self, descriptor):
        assert descriptor == KERNEL_FD

    def ioctl(self, descriptor, request, argument):
        assert descriptor == KERNEL_FD
        if request == smbus2.I2C_SLAVE:
            self.address = argument
        elif request == smbus2.I2C_FUNCS:
            argument.value = 0
        else:
            assert request == smbus2.I2C_SMBUS
            self.smbus(argument.size, argument.read_write, argument.command, argument.data.contents)

    def smbus(self, size, direction, register, data):
        count = data.block[0]
        if (size, direction) == (smbus2.I2C_SMBUS_BYTE_DATA, smbus2.I2C_SMBUS_READ):
            data.byte = self.bus.read_byte_data(self.address, register)
        elif (size, direction) == (smbus2.I2C_SMBUS_BYTE_DATA, smbus2.I2C_SMBUS_WRITE):
            self.bus.write_byte_data(self.address, register, data.byte)
        elif (size, direction) == (smbus2.I2C_SMBUS_I2C_BLOCK_DATA, smbus2.I2C_SMBUS_READ):
            data.block[1:count + 1] = self.bus.read_i2c_block_data(self.address, register, count)
        else:
            assert (size, direction) == (smbus2.I2C_SMBUS_I2C_BLOCK_DATA, smbus2.I2C_SMBUS_WRITE)
            self.bus.write_i2c_block_data(self.address, register, data.block[1:count + 1])


@pytest.fixture
def kernel(folder, monkeypatch):
    kernel = Kernel(folder)
    monkeypatch.setattr(smbus2, "os", SimpleNamespace(open=kernel.open, close=kernel.close, O_RDWR=os.O_RDWR))
    monkeypatch.setattr(smbus2, "ioctl", kernel.ioctl)
    return kernel


def test_a_chip_that_a_kernel_driver_holds_is_left_to_it(kernel, monkeypatch):
    def ioctl(descriptor, request, argument):
        assert request in (smbus2.I2C_SLAVE, smbus2.I2C_FUNCS), "not I2C_SLAVE_FORCE"
        if request == smbus2.I2C_SLAVE:
            raise OSError(errno.EBUSY, "")

    monkeypatch.setattr(smbus2, "ioctl", ioctl)
    monkeypatch.setattr(i2c, "kernel_driver", lambda device: "")
    check = motor_board.check_board("waveshare_hat", 1, "")
    assert (check.ok, check.finding) == (False, "0x40 on /dev/i2c-1 is in use by a kernel driver")


def test_the_wheels_turn_and_come_back_after_a_loss_of_power(kernel, make_robot, folder):
    robot = make_robot(i2c_bus=1)
    for speeds in ((0.5, 0.25), (0.75, 0.25), (-1, 1), (0, 0), (0.5, 0.25)):
        robot.set_motors(*speeds)
        assert wheel_speeds(folder) == wheel_speeds(folder, "waveshare") == speeds
    power_on(folder)
    robot.verify()
    assert wheel_speeds(folder) == (0.5, 0.25)


def test_no_answer(kernel, make_robot, folder):
    (folder / "0x60").unlink()
    with pytest.raises(BusError, match="^No answer from 0x60 on /dev/i2c-1."):
        make_robot(i2c_bus=1)
