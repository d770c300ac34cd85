"""Python's random: MicroPython's, and what that lacks."""

from math import cos, log, pi, sqrt
from random import *  # noqa: F403
from random import choice, random  # noqa: F401


def gauss(mu=0.0, sigma=1.0):
    """Return a number of a normal distribution (Box and Muller)."""
    return mu + sigma * sqrt(-2 * log(1 - random())) * cos(2 * pi * random())


normalvariate = gauss


def shuffle(items):
    for i in range(len(items) - 1, 0, -1):
        j = int(random() * (i + 1))
        items[i], items[j] = items[j], items[i]


def sample(items, k):
    """Return k items of a sequence, each at most once."""
    if not 0 <= k <= len(items):
        raise ValueError("Sample larger than population or is negative")
    left = list(items)
    shuffle(left)
    return left[:k]


def choices(items, weights=None, *, k=1):
    """Return k items, any of them more than once; with weights, some more often than others."""
    if weights is None:
        return [choice(items) for _ in range(k)]
    return [_weighted(items, weights) for _ in range(k)]


def _weighted(items, weights):
    at = random() * sum(weights)
    for item, weight in zip(items, weights):
        at -= weight
        if at < 0:
            return item
    return items[-1]
