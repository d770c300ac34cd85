"""Python's math: MicroPython's, and what that lacks."""

from math import *  # noqa: F403
from math import copysign, fabs, floor, fmod, inf, isinf, isnan, nan, sqrt  # noqa: F401


def remainder(x, y):
    """Return the IEEE 754 remainder: x - n * y, n being the whole number next to x / y, the even one of two."""
    x, y = float(x), float(y)
    if isnan(x) or isnan(y):
        return nan
    if isinf(x) or y == 0:
        raise ValueError("math domain error")
    rest, size = fmod(fabs(x), fabs(y)), fabs(y)
    if isinf(y):
        return x
    half = size - rest
    if rest > half or rest == half and fmod((fabs(x) - rest) / 2, size) != 0:
        rest -= size
    return copysign(1, x) * rest


def hypot(*sides):
    """Return the length of a vector."""
    largest = max([fabs(each) for each in sides] + [0.0])
    if largest in (0, inf):
        return largest
    return largest * sqrt(sum([(each / largest) ** 2 for each in sides]))


def dist(one, other):
    """Return the distance of two points of as many coordinates."""
    if len(one) != len(other):
        raise ValueError("both points must have the same number of dimensions")
    return hypot(*[a - b for a, b in zip(one, other)])


def prod(numbers, start=1):
    for each in numbers:
        start *= each
    return start


def gcd(one, other):
    while other:
        one, other = other, one % other
    return abs(one)


def isqrt(number):
    """Return the largest whole number whose square is at most this one."""
    if number < 0:
        raise ValueError("isqrt() argument must be nonnegative")
    root = number
    while root * root > number:
        root = (root + number // root) // 2
    return root


def comb(n, k):
    if n < 0 or k < 0:
        raise ValueError("n and k must be non-negative integers")
    result = 1
    for i in range(min(k, n - k)):
        result = result * (n - i) // (i + 1)
    return result if k <= n else 0
