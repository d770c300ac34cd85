"""Waits for a condition, no longer than a time limit."""

import time
from typing import Callable


def wait_until(condition: Callable[[], object], timeout: float, interval: float = 0.01) -> bool:
    """Return whether the condition becomes true within ``timeout`` seconds; it is evaluated every ``interval`` s."""
    deadline = time.monotonic() + timeout
    while not condition():
        if time.monotonic() > deadline:
            return False
        time.sleep(interval)
    return True
