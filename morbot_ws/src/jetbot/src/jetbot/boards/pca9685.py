"""The PCA9685: sixteen PWM outputs of 12 bits on an I2C bus. Names and facts: NXP data sheet, rev. 4."""

import functools
import itertools
import time
from typing import Dict, List, Sequence

from .driver import Link

MODE1 = 0x00
MODE1_RESTART = 0x80    # the chip sets it when it sleeps with outputs on; writing 1, awake, lets them go on
MODE1_AI = 0x20         # auto-increment; without it, every byte of a block is written to the same register
MODE1_SLEEP = 0x10      # oscillator and outputs off
MODE1_POWER_ON = 0x11   # asleep, answers to the address of all such chips
MODE2 = 0x01
MODE2_OUTDRV = 0x04     # outputs drive high and low; they change at the STOP of a transfer, as OCH (0x08) is 0
SUBADDRESSES = {0x02: 0xE2, 0x03: 0xE4, 0x04: 0xE8}  # SUBADR1 to SUBADR3: value at power-on
LED0_ON_L = 0x06        # four registers per output: ON_L, ON_H, OFF_L, OFF_H
LED_FULL = 0x10         # in ON_H: always on; in OFF_H: always off, and off wins
PRE_SCALE = 0xFE        # writable only asleep
PRESCALE_POWER_ON = 0x1E
FULL_DUTY = 4096
OSCILLATOR = 25e6       # Hz
OSCILLATOR_START = 0.0005  # s

REGISTERS = 256
OVERHEAD = 2            # bytes, address and register, before the data of a transfer
MAX_TRANSFERS = 3       # of a change of duties alone
MAX_BITS = 160          # on the wire, of such a change: nine per byte, and two per transfer for START and STOP

OFF = bytes([0, 0, 0, LED_FULL])
OFF_H = 3               # of the four registers of an output


class PCA9685:
    """Some outputs of the chip; the others may be another program's, as of servos, and go on as they are.

    Writes only the registers that changed, and verifies what the chip holds block by block.

    groups: outputs that switch on and off together, in the order in which ``stop`` switches them off; from the first to
    the last are 8 at most, 32 bytes, the most that one SMBus transfer carries.
    pwm_frequency: in Hz, 24 to 1526, of all outputs of the chip.
    resets, overwritten, in_sync: as in MotorDriver.
    Nothing is sent before ``start`` or the first ``set_outputs``. Every method may raise BusError.
    """

    resets = overwritten = 0

    def __init__(self, link: Link, pwm_frequency: float, groups: Sequence[Sequence[int]]):
        self.link = link
        self._outputs = [output for group in groups for output in group]
        self._prescale = prescale(pwm_frequency)
        self._spans = [range(LED0_ON_L + 4 * min(group), LED0_ON_L + 4 * max(group) + 4) for group in groups]
        self._blocks = itertools.cycle([range(MODE1, MODE2 + 1), range(PRE_SCALE, PRE_SCALE + 1), *self._spans])
        self._sent = b""  # the registers as the chip holds them; empty: not known
        self._differs = b""  # what ``verify`` read instead of what was sent

    @staticmethod
    def recognizes(link: Link) -> bool:
        """Return whether the chip that answers holds what a PCA9685 does and motor programs leave; it is only read."""
        return all(link.read(register) == value for register, value in SUBADDRESSES.items())

    @property
    def in_sync(self) -> bool:
        return bool(self._sent)

    def start(self) -> None:
        """Set the chip up, whatever state it is in: first the outputs off, and only then the rest.

        A chip that runs as wanted is not put to sleep, which would interrupt the other outputs.
        """
        self.stop()
        mode1 = self.link.read(MODE1)
        self._count_fault(mode1)
        if mode1 & MODE1_SLEEP or self.link.read(PRE_SCALE) != self._prescale:
            self._set_prescale()
        elif mode1 & ~MODE1_RESTART != MODE1_AI:
            self.link.write(MODE1, [MODE1_AI])
        sent = bytearray(REGISTERS)
        sent[MODE1], sent[MODE2], sent[PRE_SCALE] = MODE1_AI, MODE2_OUTDRV, self._prescale
        for span in self._spans:
            sent[span.start:span.stop] = OFF * (len(span) // 4)
            self.link.write(span.start, sent[span.start:span.stop])
        self._sent = bytes(sent)

    def stop(self) -> None:
        """Switch the outputs off, whatever state the chip is in; nothing else changes.

        Byte by byte: after a brown-out, without MODE1_AI, a block would end up in a single register. MODE2 comes first:
        it may invert the outputs, or let them wait for all four registers.
        """
        self._sent = b""
        self.link.write(MODE2, [MODE2_OUTDRV])
        for output in self._outputs:
            self.link.write(LED0_ON_L + 4 * output + OFF_H, [LED_FULL])

    def set_outputs(self, duties: Dict[int, int]) -> None:
        """Set outputs to duties, {output: 0 to 4096}, in 4096ths; start the chip first if its state is unknown."""
        if not self._sent:
            self.start()
        sent, wanted = self._sent, bytearray(self._sent)
        for output, duty in duties.items():
            register = LED0_ON_L + 4 * output
            wanted[register:register + 4] = encode(duty)
        if wanted == sent:
            return
        self._sent = b""  # until all of it went through
        for piece in transfers(sent, wanted, self._spans):
            self.link.write(piece.start, wanted[piece.start:piece.stop])
        self._sent = bytes(wanted)

    def verify(self) -> None:
        """Read back the next block of registers; if it differs, the next ``set_outputs`` sets the chip up again.

        A chip whose supply failed is back at its power-on values: asleep, all outputs off. Only ``start`` wakes it.
        """
        sent, self._sent = self._sent, b""  # also if the chip does not answer
        if not sent:
            return
        block = next(self._blocks)
        held = bytearray(self.link.read_block(block.start, len(block)))
        if block.start == MODE1:
            held[0] &= ~MODE1_RESTART
        if held == sent[block.start:block.stop]:
            self._sent = sent
        else:
            self._differs = bytes(held)

    def invalidate(self) -> None:
        """Something else has written to the chip: the next ``set_outputs`` sets it up again."""
        self._sent = b""

    def _set_prescale(self) -> None:
        for register, value in (MODE1, MODE1_AI | MODE1_SLEEP), (PRE_SCALE, self._prescale), (MODE1, MODE1_AI):
            self.link.write(register, [value])
        time.sleep(OSCILLATOR_START)
        self.link.write(MODE1, [MODE1_RESTART | MODE1_AI])

    def _count_fault(self, mode1: int) -> None:
        """Count why ``verify`` found the chip changed; mode1: what its MODE1 holds now."""
        if self._differs:
            if mode1 == MODE1_POWER_ON or self._differs == bytes([PRESCALE_POWER_ON]):
                self.resets += 1
            else:
                self.overwritten += 1
        self._differs = b""


def prescale(pwm_frequency: float) -> int:
    """Return PRE_SCALE for a frequency of 24 to 1526 Hz."""
    return round(OSCILLATOR / FULL_DUTY / pwm_frequency) - 1


@functools.lru_cache(maxsize=None)
def encode(duty: int) -> bytes:
    """Return an output's four registers: on at the start of each period, off after ``duty`` 4096ths of it."""
    if duty == 0:
        return OFF
    if duty == FULL_DUTY:
        return bytes([0, LED_FULL, 0, 0])
    return bytes([0, 0, duty & 0xFF, duty >> 8])


def transfers(sent: Sequence[int], wanted: Sequence[int], spans: Sequence[range]) -> List[range]:
    """Return the ranges of registers to write: those that changed, and short gaps between them.

    Where full on or full off is among the changes (a wheel starts, stops, reverses or reaches full speed), a span is
    written in one transfer, and so never has two directions on at once.
    """
    changed = [register for span in spans for register in span if sent[register] != wanted[register]]
    if not any((sent[register] ^ wanted[register]) & LED_FULL for register in changed if register % 2):
        pieces = join(sorted(changed), MAX_TRANSFERS)
        if sum(2 + 9 * (OVERHEAD + len(piece)) for piece in pieces) <= MAX_BITS:
            return pieces
    return [piece for span in spans for piece in join([register for register in changed if register in span], 1)]


def join(registers: List[int], most: int) -> List[range]:
    """Return ascending registers as at most ``most`` ranges; a gap that costs no more than a transfer is included."""
    pieces: List[range] = []
    for register in registers:
        if pieces and register - pieces[-1].stop <= OVERHEAD:
            pieces[-1] = range(pieces[-1].start, register + 1)
        else:
            pieces.append(range(register, register + 1))
    while len(pieces) > most:
        i = min(range(len(pieces) - 1), key=lambda i: pieces[i + 1].start - pieces[i].stop)
        pieces[i:i + 2] = [range(pieces[i].start, pieces[i + 1].stop)]
    return pieces
