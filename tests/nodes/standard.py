"""Python's own modules: what MicroPython has, and what it lacks."""
from __future__ import annotations, division, print_function  # noqa: UP010

import collections
import copy
import datetime
import functools
import itertools
import json
import math
import random
import re
import sys
import time
from numbers import Integral, Number
from typing import Dict, List, Optional

Names = Dict[str, List[int]]


def attempt(function, *args):
    try:
        print(function(*args))
    except (ValueError, TypeError, IndexError, OverflowError) as error:
        print(type(error).__name__)


for x, y in ((5, 3), (4.5, 3), (1.5, 1), (2.5, 1), (-5, 3), (5, -3), (7, math.inf), (-0.5, 1), (3 * math.pi, math.tau)):
    print(round(math.remainder(x, y), 9), end=" ")
print(math.copysign(1, math.remainder(-6, 3)), math.isnan(math.remainder(math.nan, 1)))
attempt(math.remainder, 1, 0)
attempt(math.remainder, math.inf, 1)
print(math.hypot(3, 4), math.hypot(), math.hypot(1, 2, 2), math.hypot(1e200, 1e200) < 2e200, math.hypot(-math.inf, 1))
print(math.dist((1, 2), (4, 6)), math.prod([1, 2, 3]), math.prod([], start=2), math.gcd(12, -18), math.isqrt(99))
print(math.comb(5, 2), math.comb(2, 5), round(math.tau, 5), math.floor(-1.5), math.isclose(1, 1 + 1e-12))
attempt(math.isqrt, -1)
attempt(math.comb, 3, -1)
attempt(math.sqrt, -1)
attempt(math.dist, (1,), (1, 2))
items = list(range(10))
random.seed(1)
random.shuffle(items)
print(sorted(items) == list(range(10)), len(set(random.sample(items, 4))), random.choice([7]), random.randint(3, 3))
print(0 <= random.random() < 1, 2 <= random.uniform(2, 3) <= 3, random.randrange(0, 10, 10), random.choices([5], k=3))
print(random.choices(["a", "b"], weights=[0, 1], k=2), sum(random.gauss(5, 1) for _ in range(400)) // 400 in (4, 5))
attempt(random.sample, [1], 2)
random.seed(7)
print(random.randint(0, 10 ** 18), random.randrange(10, 0, -3), random.randint(-5, 5))
attempt(random.randint, 2, 1)
print(isinstance(1, Number), isinstance(1.5, Number), isinstance("1", Number), isinstance(1.5, Integral))
print(time.time_ns() > 10 ** 18, time.localtime()[0] > 2020, datetime.datetime.now().year > 2020)
print(json.loads(json.dumps({"a": [1, None]}))["a"], re.sub("[0-9]+", "n", "a12"), copy.copy([1]))
print(collections.deque([1, 2], 2)[0], functools.reduce(lambda a, b: a + b, [1, 2]), list(itertools.chain([1], [2])))
print(Optional is not None, len(sys.argv), sys.version_info >= (3, 4))

#> -1.0 -1.5 -0.5 0.5 1.0 -1.0 7.0 -0.5 -3.141592654 -1.0 True
#> ValueError
#> ValueError
#> 5.0 0.0 3.0 True inf
#> 5.0 6 2 6 9
#> 10 0 6.28319 -2 True
#> ValueError
#> ValueError
#> ValueError
#> ValueError
#> True 4 7 3
#> True True 0 [5, 5, 5]
#> ['b', 'b'] True
#> ValueError
#> 455200494606748983 10 -4
#> ValueError
#> True True False False
#> True True True
#> [1, None] an [1]
#> 1 3 [1, 2]
#> True 1 True
