"""What the motors on the fake bus do with what the chip puts out."""

import pytest

from jetbot import fake
from jetbot.fake.chips import PCA9685
from jetbot.fake.motors import wheel_speeds

FULL, HALF, OFF = bytes([0, 0x10, 0, 0]), bytes([0, 0, 0, 0x08]), bytes([0, 0, 0, 0x10])  # one output's registers


@pytest.mark.parametrize("backward, forward, speed", [
    (OFF, HALF, 0.5), (HALF, OFF, -0.5), (OFF, OFF, 0.0), (FULL, FULL, 0.0), (HALF, FULL, 0.0), (FULL, HALF, 0.0)])
def test_a_motor_with_both_inputs_high_gets_no_power(folder, backward, forward, speed):
    registers = bytearray(PCA9685.POWER_ON)
    registers[0x00] = 0x01  # awake
    registers[0x06:0x0E] = backward + forward
    folder.mkdir()
    fake.chip_file(folder, 0x60).write_bytes(registers)
    assert wheel_speeds(folder, "waveshare") == (speed, 0.0)
