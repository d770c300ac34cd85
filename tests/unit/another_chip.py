"""Boards with a chip that jetbot does not know: the drivers and the simulated chip that CONTRIBUTING asks for."""

from jetbot.boards import BOARDS, Board, MotorDriver
from jetbot.fake.chips import Chip

CONTROL, LEFT, RIGHT = 0x00, 0x01, 0x02
ENABLE = 0x01


class WriteOnlyMotors(MotorDriver):
    """Two speeds in 127ths. It reads nothing back, as the contract allows."""

    resolution = 1 / 127
    chip_name = "SmallChip"

    def __init__(self, link, *settings):
        super().__init__(link, *settings)
        self._sent = None

    @property
    def in_sync(self):
        return self._sent is not None

    def start(self):
        self._sent = None
        self.link.write(LEFT, bytes(2))
        self.link.write(CONTROL, [ENABLE])
        self._sent = bytes(2)

    def drive(self, left, right):
        if self._sent is None:
            self.start()
        wanted = bytes(round(127 * speed) % 256 for speed in (left, right))
        if wanted != self._sent:
            self._sent = None  # until it went through
            self.link.write(LEFT, wanted)
            self._sent = wanted

    def invalidate(self):
        self._sent = None


class SmallMotors(WriteOnlyMotors):
    """The same, with all of it read back."""

    def verify(self):
        sent, self._sent = self._sent, None
        if sent is not None and bytes(self.link.read_block(CONTROL, 3)) == bytes([ENABLE]) + sent:
            self._sent = sent


class SmallChip(Chip):
    """CONTROL 0x00, whose bit 0 switches both motors on; their speeds, signed, in 0x01 and 0x02."""

    ADDRESSES = range(0x30, 0x38)
    POWER_ON = bytes(3)

    @staticmethod
    def speed(registers, motor, age=0.0):
        speed = int.from_bytes(registers[motor:motor + 1], "big", signed=True) / 127
        return speed if registers[CONTROL] & ENABLE else 0.0


FREE = [each for each in SmallChip.ADDRESSES if each not in [board.address for board in BOARDS.values()]]
ROWS = {name: Board(driver, FREE[0], SmallChip.ADDRESSES, chip="SmallChip", left=LEFT, right=RIGHT)
        for name, driver in (("small", SmallMotors), ("write_only", WriteOnlyMotors))}  # for BOARDS
