"""What the chips on the fake bus, and the board on the fake serial port, do with the bytes they are sent.

Written from NXP's data sheet of the PCA9685 (rev. 4), SparkFun's description of the SCMD, TI's data sheet of the INA219
(SBOS448) and Waveshare's ROS node for the JetBot Pro, not from the drivers, and with registers as plain numbers, so
that a driver's mistake shows.
"""

import math
import struct
from collections import deque
from typing import Any, Deque, List, Optional, Sequence, Tuple, Type


class Chip:
    """A chip with registers of one byte. Another kind is a subclass, which a fake bus knows by its name.

    ADDRESSES: where its pins or jumpers can put it on an I2C bus. POWER_ON: its registers at power-on.
    READ_ONLY: the registers that keep what is written to them from changing.
    """

    ADDRESSES: Sequence[int] = ()
    POWER_ON = b""
    READ_ONLY: Sequence[int] = ()

    @classmethod
    def write(cls, registers: bytearray, register: int, data: Sequence[int]) -> None:
        """Do what one transfer does that writes these bytes: if it was cut, fewer than the driver sent, or none."""
        for each, value in enumerate(data, register):
            if each not in cls.READ_ONLY:
                registers[each] = value

    @classmethod
    def read(cls, registers: bytes, register: int, length: int) -> List[int]:
        """Return the bytes that one transfer reads."""
        return list(registers[register:register + length])

    @staticmethod
    def speed(registers: bytes, motor: Any, age: float) -> float:
        """Return the speed in [-1, 1] of a motor, ``age`` seconds after the last write. motor: how it is wired."""
        return 0.0


class PCA9685(Chip):
    """Sixteen PWM outputs of 12 bits: MODE1 0x00, outputs 0x06..0x45, all outputs 0xFA..0xFD, PRE_SCALE 0xFE."""

    ADDRESSES = range(0x40, 0x78)  # 0x40 plus its pins A5 to A0; an I2C bus reserves those from 0x78 on
    POWER_ON = ((bytes([0x11, 0x04, 0xE2, 0xE4, 0xE8, 0xE0]) + bytes([0, 0, 0, 0x10]) * 16).ljust(0xFD, b"\0")
                + b"\x10\x1E\0")

    @staticmethod
    def write(registers: bytearray, register: int, data: Sequence[int]) -> None:
        for value in data:
            PCA9685._store(registers, register, value)
            register = PCA9685._next(registers, register)

    @staticmethod
    def read(registers: bytes, register: int, length: int) -> List[int]:
        values = []
        for _ in range(length):
            values.append(registers[register])
            register = PCA9685._next(registers, register)
        return values

    @staticmethod
    def _next(registers: bytes, register: int) -> int:
        if not registers[0x00] & 0x20:  # no auto-increment
            return register
        return 0x00 if register == 0x45 else (register + 1) % 256

    @staticmethod
    def _store(registers: bytearray, register: int, value: int) -> None:
        if register == 0xFE and not PCA9685.asleep(registers):
            return  # PRE_SCALE cannot be written while the chip is awake
        if register == 0x00:
            value = PCA9685._with_restart(registers, value)
        elif 0x06 <= register <= 0x45:
            registers[0x00] &= 0x7F
        registers[register] = value
        if 0xFA <= register <= 0xFD:
            first = register - 0xFA + 0x06
            registers[first:0x46:4] = bytes([value] * 16)

    @staticmethod
    def _with_restart(registers: bytes, mode1: int) -> int:
        """Return MODE1 as the chip stores it: RESTART is set by a sleep with an output on, cleared by writing 1."""
        slept = mode1 & 0x10 and any(PCA9685.duty(registers, output) for output in range(16))
        waits = registers[0x00] & 0x80 and (mode1 & 0x90 != 0x80 or PCA9685.asleep(registers))
        return mode1 & 0x7F | (0x80 if slept or waits else 0)

    @staticmethod
    def asleep(registers: bytes) -> bool:
        """Return whether the oscillator, and with it every output, is off."""
        return bool(registers[0x00] & 0x10)

    @staticmethod
    def frequency(registers: bytes) -> float:
        """Return the frequency of the PWM in Hz: 25 MHz / 4096, divided by PRE_SCALE + 1."""
        return 25e6 / 4096 / (registers[0xFE] + 1)

    @staticmethod
    def duty(registers: bytes, output: int) -> float:
        """Return the fraction of the time that an output is high: 0 to 1."""
        on = int.from_bytes(registers[0x06 + 4 * output:][:2], "little")
        off = int.from_bytes(registers[0x08 + 4 * output:][:2], "little")
        if registers[0x00] & 0x90 or off & 0x1000:  # asleep, or not restarted since
            return 0.0
        return 1.0 if on & 0x1000 else (off - on) % 4096 / 4096

    @staticmethod
    def speed(registers: bytes, motor: Tuple[Optional[int], int, int], age: float = 0.0) -> float:
        """motor: the outputs at its H bridge (PWM, forward input, backward input); PWM None: always on.

        With both inputs high, or both low, the motor gets no power.
        """
        pwm, forward, backward = motor
        ahead, back = PCA9685.duty(registers, forward), PCA9685.duty(registers, backward)
        if ahead and back:
            return 0.0
        return (ahead - back) * (1.0 if pwm is None else PCA9685.duty(registers, pwm))


class SCMD(Chip):
    """SparkFun's motor driver: ID 0x01, drive bytes 0x20 and 0x21, DRIVER_ENABLE 0x70, FSAFE_TIME 0x76, STATUS 0x77."""

    ADDRESSES = range(0x58, 0x64)  # by its jumpers
    POWER_ON = bytes({0x01: 0xA9, 0x20: 0x80, 0x21: 0x80, 0x77: 0x01}.get(register, 0) for register in range(256))
    READ_ONLY = (0x01, 0x77)

    @staticmethod
    def speed(registers: bytes, motor: int, age: float) -> float:
        """motor: the register of its drive byte, in which forward counts down."""
        timed_out = registers[0x1F] & 0x01 and registers[0x76] and age > registers[0x76] / 100
        if timed_out or not registers[0x70] & 0x01:
            return 0.0
        return (0x80 - registers[motor]) / 0x80


class INA219(Chip):
    """A voltmeter of six registers of 16 bits, the high byte first: configuration 0, bus voltage 2, calibration 5.

    Register n is in the bytes 2 n and 2 n + 1. It measures what its bus voltage is set to: V / 0.004 from bit 3 on.
    """

    ADDRESSES = (0x41, 0x42)  # of those that its pins select: on Waveshare's JetBot, on its UPS module
    POWER_ON = bytes.fromhex("399F 0000 5E8A 0000 0000 0000")  # 12.1 V
    WRITABLE = (0, 5)

    @staticmethod
    def write(registers: bytearray, register: int, data: Sequence[int]) -> None:
        if register in INA219.WRITABLE and len(data) == 2:
            registers[2 * register:2 * register + 2] = bytes(data)

    @staticmethod
    def read(registers: bytes, register: int, length: int) -> List[int]:
        return [registers[(2 * register + offset % 2) % len(registers)] for offset in range(length)]


def with_checksum(body: bytes) -> bytes:
    """Return the frame with its checksum."""
    return body + bytes([sum(body) % 256])


class JetBotPro(Chip):
    """Waveshare's JetBot Pro at the end of a serial port: takes velocity frames, and sends telemetry.

    Its registers are the last velocity frame that it received, byte by byte as on the wire.
    velocities: (mm/s, mrad/s) of the last velocity frames; bad: what was no frame.
    """

    POWER_ON = with_checksum(struct.pack(">HBB3h", 0xAA55, 11, 0x11, 0, 0, 0))

    def __init__(self) -> None:
        self.velocities: Deque[Tuple[int, int]] = deque(maxlen=1000)
        self.bad: Deque[bytes] = deque(maxlen=1000)
        self._buffer = b""

    def receive(self, data: bytes) -> bytes:
        """Take bytes from the computer; return the last velocity frame that they complete, or b""."""
        newest = b""
        self._buffer += data
        while len(self._buffer) > 2:
            length = self._buffer[2] if self._buffer.startswith(b"\xaa\x55") else 1  # what begins no frame is skipped
            if len(self._buffer) < length:
                break
            frame, self._buffer = self._buffer[:max(1, length)], self._buffer[max(1, length):]
            if len(frame) < 5 or with_checksum(frame[:-1]) != frame:
                self.bad.append(frame)
            elif frame[3] == 0x11:
                newest = frame
                self.velocities.append(decode(frame))
        return newest

    @staticmethod
    def telemetry(x: float, y: float, yaw: float, turn: float = 0.0) -> bytes:
        """Return a telemetry frame: x, y in mm, yaw in mrad, turn in rad/s; the numbers wrap as int16 do."""
        gyro = round(math.degrees(turn) / 2000 * 32768)
        pose = (wrap(round(value)) for value in (x, y, yaw))
        return with_checksum(struct.pack(">HBB6h6x3h16x", 0xAA55, 45, 0x01, 0, 0, wrap(gyro), 0, 0, 16384, *pose))

    @staticmethod
    def speed(frame: bytes, side: int, age: float = 0.0) -> float:
        """Return the speed of a wheel in m/s, for wheels 2 m apart. side: -1 left, 1 right."""
        linear, angular = decode(frame)
        return (linear + side * angular) / 1000


def decode(frame: bytes) -> Tuple[int, int]:
    """Return (mm/s, mrad/s) of a velocity frame."""
    linear, _, angular = struct.unpack_from(">3h", frame, 4)
    return linear, angular


def wrap(count: int) -> int:
    """Return the count as a signed 16-bit integer."""
    return (count + 0x8000) % 0x10000 - 0x8000


def chip_class(name: str) -> Type[Chip]:
    """Return the class of this name: a chip."""
    return {chip.__name__: chip for chip in Chip.__subclasses__()}[name]
