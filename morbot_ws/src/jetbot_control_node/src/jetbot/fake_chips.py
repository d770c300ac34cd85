"""What the chips on the fake bus do with the bytes they are sent.

Written from the data sheets and not from the drivers, registers as plain numbers, so that a driver's mistake shows.
"""


class PCA9685:
    """Sixteen PWM outputs of 12 bits: MODE1 0x00, outputs 0x06..0x45, all outputs 0xFA..0xFD, PRE_SCALE 0xFE."""

    POWER_ON = (bytes([0x11, 0x04, 0, 0, 0, 0]) + bytes([0, 0, 0, 0x10]) * 16).ljust(0xFD, b"\0") + b"\x10\x1E\0"

    @staticmethod
    def write(registers, register, data):
        """Apply one transfer to ``registers``, a bytearray of 256."""
        auto_increment = registers[0x00] & 0x20
        for value in data:
            PCA9685._store(registers, register, value)
            if auto_increment:
                register = 0x00 if register == 0x45 else (register + 1) % 256

    @staticmethod
    def _store(registers, register, value):
        if register == 0xFE and not PCA9685.asleep(registers):
            return  # PRE_SCALE cannot be written while the chip is awake
        registers[register] = value
        if 0xFA <= register <= 0xFD:
            first = register - 0xFA + 0x06
            registers[first:0x46:4] = bytes([value] * 16)

    @staticmethod
    def asleep(registers):
        """Whether the oscillator, and with it every output, is off."""
        return bool(registers[0x00] & 0x10)

    @staticmethod
    def duty(registers, output):
        """The part of the time that an output is high: 0 to 1."""
        on = int.from_bytes(registers[0x06 + 4 * output:][:2], "little")
        off = int.from_bytes(registers[0x08 + 4 * output:][:2], "little")
        if PCA9685.asleep(registers) or off & 0x1000:
            return 0.0
        return 1.0 if on & 0x1000 else (off - on) % 4096 / 4096


CHIPS = {0x60: PCA9685}
