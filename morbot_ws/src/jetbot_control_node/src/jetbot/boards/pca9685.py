"""The PCA9685: sixteen PWM outputs of 12 bits on an I2C bus (NXP data sheet, rev. 4)."""

import time

MODE1 = 0x00
SLEEP = 0x10            # oscillator and outputs off
AUTO_INCREMENT = 0x20   # without it, every byte of a block lands in the same register
RESTART = 0x80          # set by the chip itself
MODE2 = 0x01
OUTDRV = 0x04           # outputs drive high and low
FIRST_OUTPUT = 0x06     # four registers an output: ON_L, ON_H, OFF_L, OFF_H
OUTPUTS = 16
PRE_SCALE = 0xFE        # writable only asleep
FASTEST = 3             # PRE_SCALE for 25 MHz / 4096 / (3 + 1) = 1526 Hz
FULL = 0x10             # in ON_H: always on; in OFF_H: always off, and off wins
FULL_DUTY = 4096
OSCILLATOR_START = 0.0005  # seconds

BLOCK = 32              # bytes, the most that one SMBus transfer carries
ADDRESSING = 2          # bytes, address and register, before the data of a transfer
MOST_TRANSFERS = 3      # that a mere change of duties may take,
MOST_BITS = 160         # and bits on the wire, each byte with its acknowledgement, each transfer with start and stop


class PCA9685:
    """Writes only what changed, in as few bytes as the chip's auto-increment allows, and can tell what it forgot.

    link: an I2CDevice; groups: ranges of up to 8 outputs, those that must switch on and off together.
    Nothing is sent before ``start`` or the first ``set_outputs``. Every method raises BusError.
    """

    def __init__(self, link, groups):
        self._link = link
        self._spans = [range(4 * group.start, 4 * group.stop) for group in groups]
        self._sent = None  # the output registers as the chip holds them; None: not known

    def start(self):
        """Set the chip up, whatever state it is in, with all outputs off before it wakes."""
        self._link.read(MODE1)
        self._link.write(MODE1, [SLEEP | AUTO_INCREMENT])
        off = encode(0) * OUTPUTS
        for start in range(0, len(off), BLOCK):
            self._link.write(FIRST_OUTPUT + start, off[start:start + BLOCK])
        self._link.write(PRE_SCALE, [FASTEST])
        self._link.write(MODE2, [OUTDRV])
        self._link.write(MODE1, [AUTO_INCREMENT])
        time.sleep(OSCILLATOR_START)
        self._sent = bytearray(off)

    def set_outputs(self, duties):
        """Bring outputs to new duties, a dict of output: 0 to 4096 (of 4096); start the chip first where needed."""
        if self._sent is None:
            self.start()
        sent, wanted = self._sent, bytearray(self._sent)
        for output, duty in duties.items():
            wanted[4 * output:4 * output + 4] = encode(duty)
        self._sent = None  # until all of it went through
        for piece in transfers(sent, wanted, self._spans):
            self._link.write(FIRST_OUTPUT + piece.start, wanted[piece.start:piece.stop])
        self._sent = wanted

    def verify(self):
        """Read back what the chip holds; if it lost it, the next ``set_outputs`` sets the chip up again.

        A chip whose supply failed is back at its power-on values: asleep, all outputs off.
        """
        sent, self._sent = self._sent, None  # also when the chip does not answer
        if sent is not None and self._holds(sent):
            self._sent = sent

    def _holds(self, sent):
        mode1, mode2 = self._link.read_block(MODE1, 2)
        return (mode1 & ~RESTART, mode2, self._link.read(PRE_SCALE)) == (AUTO_INCREMENT, OUTDRV, FASTEST) and all(
            self._link.read_block(FIRST_OUTPUT + span.start, len(span)) == sent[span.start:span.stop]
            for span in self._spans)


def encode(duty):
    """An output's four registers: on at the start of each period, off after ``duty`` 4096ths of it."""
    if duty == 0:
        return bytes([0, 0, 0, FULL])
    if duty == FULL_DUTY:
        return bytes([0, FULL, 0, 0])
    return bytes([0, 0, duty & 0xFF, duty >> 8])


def transfers(sent, wanted, spans):
    """The ranges of the output registers to send: those that changed, and short gaps between them.

    Where full on or full off is among the changes (a wheel starts, stops, turns round or reaches full speed),
    a span goes out in one piece, and so never has two directions on at once.
    """
    changed = [i for i in range(len(wanted)) if sent[i] != wanted[i]]
    if not any((sent[i] ^ wanted[i]) & FULL for i in changed if i % 2):
        pieces = join(changed, MOST_TRANSFERS)
        if sum(2 + 9 * (ADDRESSING + len(piece)) for piece in pieces) <= MOST_BITS:
            return pieces
    return [piece for span in spans for piece in join([i for i in changed if i in span], 1)]


def join(indices, most):
    """Ascending indices as ranges: as few as ``most``, and fewer where a gap costs no more than a transfer."""
    pieces = [range(i, i + 1) for i in indices]
    while len(pieces) > 1:
        gap, i = min((after.start - before.stop, i) for i, (before, after) in enumerate(zip(pieces, pieces[1:])))
        if gap > ADDRESSING and len(pieces) <= most:
            break
        pieces[i:i + 2] = [range(pieces[i].start, pieces[i + 1].stop)]
    return pieces
