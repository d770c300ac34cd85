"""The file of a chip: its registers, and at the end the name of its class, which a dump shows."""

import errno
import functools
import os
from pathlib import Path
from typing import Optional, Tuple, Type

from ..boards import BOARDS
from ..errors import BusError
from . import power_on_command
from .chips import INA219, PCA9685, Chip, chip_class

LABEL = 16  # bytes of the name
MAX_SIZE = 1024


def label(chip: Type[Chip]) -> bytes:
    """Return what stands at the end of the file of such a chip."""
    return chip.__name__.encode().ljust(LABEL, b"\0")


@functools.lru_cache(maxsize=64)
def labelled(text: bytes) -> Optional[Type[Chip]]:
    """Return the class of the chip with this label, None if it is none."""
    return next((chip for chip in Chip.__subclasses__() if label(chip) == text), None)


def chip_in(content: bytes, address: Optional[int]) -> Tuple[Type[Chip], bytes]:
    """Return the chip in a file, and its registers. Earlier versions wrote no label; there the address tells."""
    chip = labelled(content[-LABEL:])
    if chip:
        return chip, content[:-LABEL]
    return INA219 if len(content) == len(INA219.POWER_ON) else chip_at(address), content


def chip_at(address: Optional[int]) -> Type[Chip]:
    """Return the class of a motor board's chip at this address: a board's own, or a PCA9685; None: the serial port."""
    return next((chip_class(board.chip) for board in BOARDS.values() if board.address == address), PCA9685)


def read_open(descriptor: int, file: str, address: Optional[int]) -> Tuple[Type[Chip], bytes]:
    """Return the chip in an open file, and its registers; raise BusError if it is not as large as that chip's."""
    chip, registers = chip_in(os.pread(descriptor, MAX_SIZE, 0), address)
    if len(registers) != len(chip.POWER_ON):
        raise BusError(f"{file} is not a chip, which is a file of {len(chip.POWER_ON) + LABEL} bytes",
                       f"Make a new one: {power_on_command(Path(file).parent)}", errno.EINVAL)
    return chip, registers


def read_chip(file: str, address: Optional[int]) -> Tuple[Type[Chip], bytes, float]:
    """Return the chip in a file, its registers, and the time of the last write to it; raise as ``read_open``."""
    with open(file, "rb", buffering=0) as stream:
        return (*read_open(stream.fileno(), file, address), os.fstat(stream.fileno()).st_mtime)
