"""Dictionaries keep the order of their items, wherever these come from."""

import json
from collections import OrderedDict

speeds = {"forward": 0.5, "left": 0.2, "back": -0.4, "zero": 0, "1": 1, "a": 2, "Z": 3}
for name, value in speeds.items():
    print(name, value)
del speeds["left"]
speeds["left"] = 7
speeds["back"] = 0
print(speeds, list(speeds), list(speeds.values()), len(speeds), "zero" in speeds)
print(speeds.pop("zero"), speeds.popitem(), speeds.get("none"), speeds.setdefault("new", [1]), speeds)
print(dict(z=1, y=2, x=3), dict([("b", 1), ("a", 2)]), dict(zip("hello", range(5))), {n: n * n for n in (5, 3, 9, 1)})
print({word: len(word) for word in "the quick brown fox jumps over a lazy dog".split()})
print(json.loads('{"z": 1, "a": [2, {"y": 3, "b": 4}]}'), speeds.copy(), dict.fromkeys("zyx", 0), OrderedDict([("q", 1)])["q"])


def named(**values):
    return values


print(named(zeta=1, alpha=2, mid=3), {**named(c=1, b=2), "a": 3})
counts = {}
for letter in "mississippi":
    counts[letter] = counts.get(letter, 0) + 1
print(counts, max(counts, key=counts.get), sorted(counts.items(), key=lambda item: (-item[1], item[0])))
large = {number * 37 % 1009: number for number in range(1009)}
print(list(large)[:9], sum(large.values()), large[36], {(1, 2): "tuple", 1.5: "float", None: "none", True: "bool"})
speeds["missing"] += 1
