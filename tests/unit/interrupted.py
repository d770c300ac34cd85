"""A chip on a bus that is interrupted at any byte. Written from the chips' data sheets, not from the drivers."""

import errno
import functools

from jetbot.boards import BOARDS

EVERY = (1 << 4096) - 1  # each of the 4096 counts of a period, as a bit
NACK_AND_STOP, BROWN_OUT, CUT = "not acknowledged, then STOP", "brown-out", "cable cut, no STOP"


class InterruptedPCA9685:
    """Takes the place of ``smbus2.SMBus``, with a PCA9685 by NXP's data sheet, rev. 4.

    Its outputs change at the STOP of a transfer (OCH = 0); after a cut, its bytes take effect at the next STOP.
    ``interrupt`` lets one byte fail. seen: the registers after every byte, as a transfer may end there with a STOP.
    """

    POWER_ON = bytes([0x11, 0x04, 0, 0, 0, 0]) + bytes([0, 0, 0, 0x10]) * 16 + bytes(0xFE - 0x46) + bytes([0x1E, 0])

    def __init__(self):
        self.registers = bytearray(self.POWER_ON)
        self.seen = []
        self.bytes = 0
        self._fault, self._refused, self._refused_later = None, 0, 0

    def interrupt(self, after, kind, refused=0):
        """Let the fault happen after so many bytes; ``refused``: how many transfers after it fail too."""
        self.bytes, self._fault, self._refused_later = 0, (after, kind), refused

    @property
    def was_interrupted(self):
        """Whether no fault is pending."""
        return self._fault is None

    def read_byte_data(self, address, register):
        return self.read_i2c_block_data(address, register, 1)[0]

    def read_i2c_block_data(self, address, register, length):
        self._transfer(3 + length)  # address, register, address
        values = []
        for _ in range(length):
            values.append(self.registers[register])
            register = self._next(register)
        return values

    def write_byte_data(self, address, register, value):
        self.write_i2c_block_data(address, register, [value])

    def write_i2c_block_data(self, address, register, data):
        self._transfer(2 + len(data), register, data)

    def close(self):
        pass

    def _transfer(self, length, register=0, data=()):
        """Carry so many bytes, the last of which are the data for the registers from this one on."""
        if self._refused:
            self._refused -= 1
            raise no_answer()
        carried = min(length, self._fault[0] - self.bytes) if self._fault else length
        self.bytes += carried
        for value in data[:max(0, carried - 2)]:
            self._store(register, value)
            self.seen.append(bytes(self.registers))
            register = self._next(register)
        if carried < length:
            kind, self._fault, self._refused = self._fault[1], None, self._refused_later
            if kind == BROWN_OUT:
                self.registers[:] = self.POWER_ON
            raise no_answer()

    def _store(self, register, value):
        asleep = self.registers[0] & 0x10
        if register == 0xFE and not asleep:
            return
        if register == 0:
            restart = self.registers[0] & ~value & 0x80  # until 1 is written
            slept = value & 0x10 and not asleep and any(map(self._is_on, range(16)))
            value = value & 0x7F | (0x80 if slept else restart)
        if 0xFA <= register <= 0xFD:
            self.registers[register - 0xFA + 6:0x46:4] = bytes([value] * 16)
            return
        self.registers[register] = value

    def _is_on(self, output):
        return not self.registers[0x09 + 4 * output] & 0x10

    def _next(self, register):
        if not self.registers[0] & 0x20:
            return register
        return 0 if register == 0x45 else (register + 1) % 256


class InterruptedSCMD(InterruptedPCA9685):
    """The same with SparkFun's motor driver, whose motors change with every byte."""

    POWER_ON = bytes({0x01: 0xA9, 0x20: 0x80, 0x21: 0x80, 0x77: 0x01}.get(register, 0) for register in range(256))

    def _store(self, register, value):
        if register not in (0x01, 0x77):
            self.registers[register] = value

    def _next(self, register):
        return register + 1


@functools.lru_cache(maxsize=None)
def part(motor):
    """Where the registers of a motor's outputs are."""
    used = [output for output in motor if output is not None]
    return slice(6 + 4 * min(used), 10 + 4 * max(used))


def wheels(registers, board):
    """The speeds (left, right) of a robot of this board with these registers, as bytes."""
    if board == "sparkfun":
        return tuple((0x80 - registers[drive]) / 0x80 if registers[0x70] else 0.0 for drive in (0x20, 0x21))
    if registers[0] & 0x10:
        return 0.0, 0.0
    left, right = BOARDS[board].left, BOARDS[board].right
    return speed(left, registers[part(left)]), speed(right, registers[part(right)])


@functools.lru_cache(maxsize=None)
def speed(motor, registers):
    """The part of the time in which the bridge drives forward, less the part in which it drives backward.

    registers: those in ``part(motor)``.
    """
    enabled, ahead, back = (EVERY if output is None else high(registers[6 + 4 * output - part(motor).start:])
                            for output in motor)
    return (bin(enabled & ahead & ~back).count("1") - bin(enabled & back & ~ahead).count("1")) / 4096


def high(output):
    """The counts of a period, as bits, at which an output is high; its registers come first."""
    on, off = output[0] | output[1] << 8, output[2] | output[3] << 8
    if off & 0x1000:
        return 0
    if on & 0x1000:
        return EVERY
    on, off = on & 0xFFF, off & 0xFFF
    if on <= off:
        return (1 << off) - (1 << on)
    return EVERY - (1 << on) + (1 << off)


def no_answer():
    return OSError(errno.EREMOTEIO, "Remote I/O error")
