"""What happens to a bus and to the chip on it, by files alone. The words are those of PX4's failure injection.

off: the chip is unplugged; stuck: no transfer ends; garbage: anything in its outputs; wrong: one bit; slow: at 10 kHz;
delayed: transfers take long, now and then; intermittent: they fail, now and then.
"""

import contextlib
import fcntl
import os
import random
import struct
import threading
from pathlib import Path
from typing import Callable

from jetbot.wait import wait_until

F_OFD_SETLK = 37  # fcntl(2): a lock of an open file, not of this process, whose Observer opens it too
LOCK = struct.pack("hhqqi4x", fcntl.F_WRLCK, os.SEEK_SET, 0, 0, 0)
LOCK_TIMEOUT = 0.5   # s; a transfer takes milliseconds
DELAY = 0.12         # s, of a transfer at most: less than the controller ends at
INTERVAL = 0.3       # s between two of what happens now and then
OUTPUTS = range(0x06, 0x46)  # registers of a PCA9685: LED0_ON_L to LED15_OFF_H
REGISTERS = [0x00, 0x01, *OUTPUTS, 0xFE]  # MODE1, MODE2, the outputs, PRE_SCALE


def off(scene, process, _chance):
    chip = scene.chip(process.robot)
    chip.rename(f"{chip}.out")
    return lambda: Path(f"{chip}.out").rename(chip)


def stuck(scene, process, _chance):
    descriptor = os.open(scene.chip(process.robot), os.O_RDWR | os.O_CLOEXEC)
    try:
        lock(descriptor)
    except BlockingIOError:
        os.close(descriptor)
        raise
    return lambda: os.close(descriptor)


def lock(descriptor: int) -> None:
    """Keep all others from a chip until it is closed; raise BlockingIOError if another fault does already."""
    def locked():
        with contextlib.suppress(BlockingIOError):
            return fcntl.fcntl(descriptor, F_OFD_SETLK, LOCK)
        return None

    if not wait_until(locked, LOCK_TIMEOUT, 0.001):
        raise BlockingIOError("another fault holds the chip")


def garbage(scene, process, chance):
    change(scene.chip(process.robot), OUTPUTS.start, bytes(chance.randrange(256) for _ in OUTPUTS))


def wrong(scene, process, chance):
    chip, register = scene.chip(process.robot), chance.choice(REGISTERS)
    change(chip, register, bytes([chip.read_bytes()[register] ^ 1 << chance.randrange(8)]))


def change(chip: Path, register: int, data: bytes) -> None:
    """Write to a chip as any other program may, between two transfers."""
    with chip.open("r+b", buffering=0) as file:
        lock(file.fileno())
        os.pwrite(file.fileno(), data, register)


def slow(scene, process, _chance):
    """Let the next transfers fail: the driver opens the bus again, and finds it at 10 kHz."""
    chip = scene.chip(process.robot)
    chip.with_name("clock").write_text("10000")
    chip.with_name(f"{chip.name}.fail").write_text("2")
    return lambda: chip.with_name("clock").unlink(missing_ok=True)  # two may overlap


def now_and_then(act: Callable[[Path, random.Random], None]) -> Callable:
    """Return a fault that does this to a chip every INTERVAL."""
    def begin(scene, process, chance):
        ended, chip = threading.Event(), scene.chip(process.robot)

        def repeat():
            while not ended.wait(INTERVAL):
                with contextlib.suppress(OSError):  # it is unplugged as well
                    act(chip, chance)

        thread = threading.Thread(target=repeat, daemon=True)
        thread.start()
        return lambda: (ended.set(), thread.join())
    return begin


def hold_up(chip: Path, chance: random.Random) -> None:
    with chip.open("r+b", buffering=0) as file:
        lock(file.fileno())
        threading.Event().wait(chance.uniform(0, DELAY))


def fail(chip: Path, chance: random.Random) -> None:
    chip.with_name(f"{chip.name}.fail").write_text(str(chance.randint(1, 4)))


delayed, intermittent = now_and_then(hold_up), now_and_then(fail)
