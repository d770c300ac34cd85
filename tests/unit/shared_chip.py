"""A PCA9685 that motors and a servo share. Written from NXP's data sheet, rev. 4, not from the drivers."""

import time

from jetbot.fake.bus import FakeBus, no_answer

SLEEP, AI, RESTART, INVRT, OCH = 0x10, 0x20, 0x80, 0x10, 0x08
OSCILLATOR_START = 0.0005  # s


class SharedPCA9685(FakeBus):
    """A bus in memory with this chip alone. seen: the pulse of the output ``watched`` after every STOP."""

    def __init__(self, watched):
        self.watched = watched
        self.memory = bytearray([0x11, 0x04, 0xE2, 0xE4, 0xE8, 0xE0] + [0, 0, 0, 0x10] * 16).ljust(256, b"\0")
        self.memory[0xFE] = 0x1E
        self.seen = []
        self.transfers, self.failing = 0, range(0)  # failing: those that are not acknowledged, by number
        self._active = {output: bytes([0, 0, 0, 0x10]) for output in range(16)}  # what each output does
        self._halted, self._woken_at = set(), 0.0

    def high(self, output):
        """How many 4096ths of the time an output is high; None while the oscillator or a RESTART keeps it from that."""
        if self.memory[0] & SLEEP or output in self._halted:
            return None
        on, off = (int.from_bytes(self._active[output][i:i + 2], "little") for i in (0, 2))
        count = 0 if off & 0x1000 else 4096 if on & 0x1000 else (off - on) % 4096
        return 4096 - count if self.memory[1] & INVRT else count

    def pulse(self, output):
        """(high in us, frequency in Hz) of an output, or None."""
        step = (self.memory[0xFE] + 1) / 25
        high = self.high(output)
        return None if high is None else (round(high * step), round(1e6 / 4096 / step))

    def read_i2c_block_data(self, address, register, length):
        self._acknowledge()
        values = []
        for _ in range(length):
            values.append(self.memory[register])
            register = self._next(register)
        return values

    def write_i2c_block_data(self, address, register, data):
        self._acknowledge()
        written = []
        for value in data:
            written += self._store(register, value)
            register = self._next(register)
        for output in {(each - 6) // 4 for each in written}:
            registers = range(6 + 4 * output, 10 + 4 * output)
            if not self.memory[1] & OCH or set(registers) <= set(written):
                self._active[output] = bytes(self.memory[registers.start:registers.stop])
                self._halted.discard(output)
        self.seen.append(self.pulse(self.watched))

    def _acknowledge(self):
        self.transfers += 1
        if self.transfers in self.failing:
            raise no_answer()

    def _next(self, register):
        return (0 if register == 0x45 else (register + 1) % 256) if self.memory[0] & AI else register

    def _store(self, register, value):
        """Store a byte; return the registers of outputs that it has changed."""
        if register == 0:
            self._store_mode1(value)
        elif register == 0xFE and not self.memory[0] & SLEEP:
            return []
        elif 0xFA <= register <= 0xFD:
            self.memory[register - 0xFA + 6:0x46:4] = bytes([value] * 16)
            return [*range(register - 0xFA + 6, 0x46, 4)]
        else:
            self.memory[register] = value
        if 0x06 <= register <= 0x45:
            self.memory[0] &= ~RESTART
            return [register]
        return []

    def _store_mode1(self, value):
        before = self.memory[0]
        restart = before & RESTART
        if value & SLEEP and not before & SLEEP:
            self._halted |= {output for output in range(16) if self.high(output)}
            restart = RESTART if self._halted else 0
        elif before & SLEEP and not value & SLEEP:
            self._woken_at = time.monotonic()
        elif restart and value & RESTART and time.monotonic() - self._woken_at >= OSCILLATOR_START:
            restart = 0
            self._halted.clear()
        self.memory[0] = value & ~RESTART | restart
