"""A chip on a bus that is interrupted at any byte."""

import functools

from jetbot.boards import BOARDS
from jetbot.fake.bus import FakeBus, no_answer
from jetbot.fake.chips import chip_class

NACK_AND_STOP, BROWN_OUT, CUT = "not acknowledged, then STOP", "brown-out", "cable cut, no STOP"


class InterruptedChip(FakeBus):
    """A bus in memory, with a chip of ``jetbot.fake.chips``, which takes each byte by itself.

    The outputs of a PCA9685 change at the STOP of a transfer (OCH = 0); after a cut, its bytes take effect at the next
    STOP. ``interrupt`` lets one byte fail. seen: the registers after every byte, as a transfer may end there with a
    STOP.
    """

    def __init__(self, board):
        self.chip = chip_class(BOARDS[board].chip)
        self.registers = bytearray(self.chip.POWER_ON)
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

    def read_i2c_block_data(self, address, register, length):
        self._carry(3 + length)  # address, register, address
        return self.chip.read(self.registers, register, length)

    def write_i2c_block_data(self, address, register, data):
        self._carry(2 + len(data), register, data)

    def _carry(self, length, register=0, data=()):
        """Carry so many bytes, the last of which are the data for the registers from this one on."""
        if self._refused:
            self._refused -= 1
            raise no_answer()
        carried = min(length, self._fault[0] - self.bytes) if self._fault else length
        self.bytes += carried
        states = after_each_byte(self.chip, bytes(self.registers), register, tuple(data))[:max(0, carried - 2)]
        if states:
            self.registers[:] = states[-1]
            self.seen += states
        if carried < length:
            kind, self._fault, self._refused = self._fault[1], None, self._refused_later
            if kind == BROWN_OUT:
                self.registers[:] = self.chip.POWER_ON
            raise no_answer()


@functools.lru_cache(maxsize=1000)
def after_each_byte(chip, registers, register, data):
    """The registers of a chip after each byte of a transfer, in case that it ends there."""
    states = []
    for end in range(1, len(data) + 1):
        changed = bytearray(registers)
        chip.write(changed, register, data[:end])
        states.append(bytes(changed))
    return states


@functools.lru_cache(maxsize=100_000)
def wheels(registers, board):
    """The speeds (left, right) of the simulated robot with this board and these registers, as bytes."""
    row = BOARDS[board]
    return tuple(chip_class(row.chip).speed(registers, motor, 0.0) for motor in (row.left, row.right))
