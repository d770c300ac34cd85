"""What an option or a parameter must be."""

import math
from contextlib import suppress
from typing import Any, Callable, NamedTuple, Union

from .errors import InvalidValue
from .text import literal


class Kind(NamedTuple):
    """What a value must be: a check, and its description."""

    accepts: Callable[[Any], bool]
    description: str

    def check(self, name: str, value: object) -> None:
        """Raise InvalidValue, which names the value, unless it is of this kind."""
        if not self.accepts(value):
            raise InvalidValue(f"{name} must be {self.description}, not {literal(value)}")


def is_finite(value: Any) -> bool:
    """Return whether this is a finite number, of Python or another library."""
    try:
        return math.isfinite(value)
    except (TypeError, ValueError, OverflowError):  # OverflowError: an int that is too large for a float
        return False


def is_number(value: Any) -> bool:
    """Return whether this is a finite number; not a bool, which YAML's yes and no would give."""
    return is_finite(value) and not isinstance(value, bool)


def whole(limit: int) -> Kind:
    """Return the kind of a whole number from 1 to this one."""
    return Kind(lambda value: type(value) is int and 1 <= value <= limit, f"a whole number from 1 to {limit}")


def is_address(value: Any) -> bool:
    """Return whether a chip may have this I2C address: a number, or its hexadecimal text as roslaunch passes it on."""
    with suppress(ValueError, TypeError):
        return type(value) in (int, str) and 0x03 <= address_of(value) <= 0x77
    return False


def address_of(value: Union[int, str]) -> int:
    """Return an I2C address, given as a number or as text, as a number; raise ValueError for other text."""
    return int(str(value), 0)


FINITE = Kind(is_finite, "a finite number")
NUMBER = Kind(is_number, "a number")
POSITIVE = Kind(lambda value: is_number(value) and value > 0, "a number above 0")
SECONDS = Kind(lambda value: is_number(value) and value >= 0, "a number of seconds, 0 or more")
FRACTION = Kind(lambda value: is_number(value) and 0 <= value < 1, "a number of at least 0 and below 1")
BOOLEAN = Kind(lambda value: isinstance(value, bool), "true or false")
DUTY = Kind(lambda value: is_number(value) and 0 < value <= 1, "a number above 0, 1 at most")
NON_NEGATIVE = Kind(lambda value: is_number(value) and value >= 0, "a number, 0 or more")
PWM_FREQUENCY = Kind(lambda value: is_number(value) and 24 <= value <= 1526, "a number from 24 to 1526")
ADDRESS = Kind(is_address, "an address from 0x03 to 0x77")


def check_duties(min_duty: float, max_duty: float) -> None:
    """Raise InvalidValue unless 0 <= min_duty < max_duty <= 1."""
    FRACTION.check("the min_duty", min_duty)
    DUTY.check("the max_duty", max_duty)
    if min_duty >= max_duty:
        raise InvalidValue(f"the min_duty, {min_duty:g}, must be below the max_duty, {max_duty:g}",
                           "Lower the one, or raise the other.")
