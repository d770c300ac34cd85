"""What the motors wired to a chip on the fake bus do. By hand: python3 -m jetbot.fake_motors [FOLDER] [BOARD]

Written from the boards' circuit diagrams and not from ``boards``, so that a driver's mistake shows.
"""

import sys
import time

from .fake_chips import PCA9685, SCMD
from .fake_i2c import chip_file, default_folder

# board: (left, right), each the PCA9685 outputs at its motor driver: PWM (None: always on), forward input, other input
MOTORS = {
    "adafruit": ((8, 9, 10), (13, 12, 11)),
    "waveshare": ((None, 1, 0), (None, 2, 3)),
}


def motor_speed(registers, pwm, forward, backward):
    """Speed in [-1, 1] of a motor behind an H bridge; with both inputs high, or both low, it stands."""
    ahead, back = PCA9685.duty(registers, forward), PCA9685.duty(registers, backward)
    if ahead and back:
        return 0.0
    return (ahead - back) * (1.0 if pwm is None else PCA9685.duty(registers, pwm))


def wheel_speeds(folder, board="adafruit"):
    """Speeds (left, right) of the robot with this board on the fake bus; 0 where its chip is unplugged."""
    chip = chip_file(folder, 0x5D if board == "sparkfun" else 0x60)
    try:
        registers, written = chip.read_bytes(), chip.stat().st_mtime
    except FileNotFoundError:
        return 0.0, 0.0
    if board == "sparkfun":
        return tuple(SCMD.speed(registers, motor, time.time() - written) for motor in (0, 1))
    return tuple(motor_speed(registers, *motor) for motor in MOTORS[board])


def main(folder=None, board="adafruit"):
    """Print a line whenever a wheel changes its speed."""
    shown = None
    while True:
        speeds = wheel_speeds(folder or default_folder(), board)
        if speeds != shown:
            print("left wheel {:+4.0%}, right wheel {:+4.0%}".format(*speeds), flush=True)
            shown = speeds
        time.sleep(0.1)


if __name__ == "__main__":
    try:
        main(*sys.argv[1:])
    except KeyboardInterrupt:
        pass
