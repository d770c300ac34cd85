"""What the motors wired to a chip on the fake bus do.

Written from the boards' circuit diagrams and not from ``boards``, so that a driver's mistake shows.
"""

import time

from .bus import chip_file
from .chips import PCA9685, SCMD

# board: (left, right), each the PCA9685 outputs at its motor driver: PWM (None: always on), forward input, other input
MOTORS = {
    "adafruit": ((8, 9, 10), (13, 12, 11)),
    "waveshare": ((None, 1, 0), (None, 2, 3)),
}
MOTORS["jetbot"] = MOTORS["adafruit"]  # that driver serves both boards; this robot has the one
WIRED = (*MOTORS, "sparkfun")          # every board that a robot on the fake bus can have

STILL = (0.0, 0.0)  # speeds (left, right) of wheels that stand


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
        return STILL
    if board == "sparkfun":
        return tuple(SCMD.speed(registers, motor, time.time() - written) for motor in (0, 1))
    return tuple(motor_speed(registers, *motor) for motor in MOTORS[board])
