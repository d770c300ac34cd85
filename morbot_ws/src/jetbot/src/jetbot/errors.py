"""The errors: each is a JetbotError, and one of a value or of the bus a ValueError or OSError too."""

import errno as numbers
import os
from typing import Callable, Optional

from .text import printable

EXHAUSTED = (numbers.EMFILE, numbers.ENFILE, numbers.ENOMEM)  # not EAGAIN: an I2C bus that lost its arbitration


def fake_advice(option: str) -> str:
    """Return how a script selects "fake" for an option of its Robot."""
    return f'use Robot({option}="fake"), or type first: export JETBOT_{option.upper()}=fake'


class JetbotError(Exception):
    """One sentence for the user: what is wrong (``reason``) and what to do about it (``advice``).

    option: the option of Robot, i2c_bus or port, whose value "fake" avoids the error; "" if none does.
    """

    def __init__(self, reason: str, advice: str = "", option: str = ""):
        super().__init__(reason, advice)
        self.reason, self.advice, self.option = printable(reason), printable(advice), option

    def __str__(self) -> str:
        return self.text(fake_advice)

    def text(self, advise: Callable[[str], str]) -> str:
        """Return the whole text. advise: returns how to select "fake" for an option, where this program was started."""
        without = f"Without a robot, {advise(self.option)}" if self.option else ""
        return " ".join(filter(None, (f"{self.reason[0].upper()}{self.reason[1:]}.", self.advice, without)))


class InvalidValue(JetbotError, ValueError):
    """A speed, an option or a parameter that cannot be used."""


class BusError(JetbotError, OSError):
    """The motor board cannot be driven; ``errno`` is the operating system's, or None."""

    def __init__(self, reason: str, advice: str = "", errno: Optional[int] = None, option: str = ""):
        super().__init__(reason, advice, option)
        self.errno, self.strerror = errno, reason


class NoAnswer(BusError):
    """The bus works, but the board does not answer, or another chip does."""


class BusStuck(BusError):
    """A transfer does not end: something holds the bus."""


class NotReady(BusError):
    """The board answers, but is still starting."""


class FatalError(JetbotError):
    """The program cannot go on: it stops the wheels and ends."""


class OutOfResources(FatalError):
    """This computer, or this program, has no file descriptor or memory left: ``errno`` is one of EXHAUSTED."""

    def __init__(self, errno: int):
        super().__init__(f"out of file descriptors or memory: {os.strerror(errno)}",
                         "End other programs, or raise the limits of this one.")


class GuardError(FatalError):
    """There is no guard, and none can be started."""
