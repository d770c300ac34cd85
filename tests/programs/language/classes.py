"""Classes, properties, decorators, generators, exceptions and contexts."""

import math
from functools import reduce


class Shape:
    sides = 0
    made = []

    def __init__(self, name):
        self.name = name
        Shape.made.append(name)

    def area(self):
        raise NotImplementedError(self.name)

    def __lt__(self, other):
        return self.area() < other.area()

    def __str__(self):
        return f"{type(self).__name__} {self.name}: {self.area():.2f}"

    @property
    def loud(self):
        return self.name.upper()

    @staticmethod
    def count():
        return len(Shape.made)

    @classmethod
    def unit(cls):
        return cls("unit", 1)


class Circle(Shape):
    def __init__(self, name, radius):
        super().__init__(name)
        self._radius = radius

    def area(self):
        return math.pi * self._radius ** 2

    @property
    def radius(self):
        return self._radius

    @radius.setter
    def radius(self, value):
        if value < 0:
            raise ValueError("too small")
        self._radius = value


class Square(Shape):
    sides = 4

    def __init__(self, name, side):
        Shape.__init__(self, name)
        self.side = side

    def area(self):
        return self.side ** 2


shapes = [Circle("c", 1), Square("s", 2), Circle("d", 0.5), Square.unit()]
print(*[str(each) for each in sorted(shapes)], sep="; ")
print(Shape.count(), Square.sides, shapes[1].loud, isinstance(shapes[0], Shape), issubclass(Circle, Square), min(shapes).name)
shapes[0].radius = 3
print(shapes[0].radius, round(shapes[0].area(), 3), hasattr(shapes[1], "radius"), getattr(shapes[1], "radius", None))
try:
    shapes[0].radius = -1
except ValueError as error:
    print("error:", error, type(error).__name__, error.args)


class Vector:
    def __init__(self, x, y):
        self.x, self.y = x, y

    def __add__(self, other):
        return Vector(self.x + other.x, self.y + other.y)

    def __mul__(self, factor):
        return Vector(self.x * factor, self.y * factor)

    __rmul__ = __mul__

    def __eq__(self, other):
        return (self.x, self.y) == (other.x, other.y)

    def __repr__(self):
        return f"Vector({self.x}, {self.y})"

    def __len__(self):
        return 2

    def __getitem__(self, index):
        return (self.x, self.y)[index]

    def __iter__(self):
        yield self.x
        yield self.y

    def __call__(self, *given, **named):
        return given, named

    def __contains__(self, value):
        return value in (self.x, self.y)

    def __bool__(self):
        return self.x != 0

    def __neg__(self):
        return Vector(-self.x, -self.y)

    def __abs__(self):
        return math.sqrt(self.x ** 2 + self.y ** 2)


v = Vector(1, 2) + 3 * Vector(0.5, 1)
print(v, v == Vector(2.5, 5), len(v), list(v), v[1], v(1, k=2), 5 in v, bool(Vector(0, 1)), -v, abs(Vector(3, 4)), [v])


class Stop(Exception):
    def __init__(self, reason, code=3):
        super().__init__(reason)
        self.code = code


class Timer:
    def __enter__(self):
        print("enter")
        return self

    def __exit__(self, kind, value, trace):
        print("exit", kind and kind.__name__, value)
        return kind is Stop


with Timer() as timer:
    print(type(timer).__name__)
    raise Stop("enough")


def logged(function):
    def inner(*given, **named):
        print("call", given, named)
        return function(*given, **named)
    return inner


def repeated(times):
    def decorate(function):
        def inner(*given):
            return [function(*given) for _ in range(times)]
        return inner
    return decorate


@logged
def add(a, b=1):
    return a + b


@repeated(3)
@logged
def double(a):
    return 2 * a


print(add(1), add(2, b=3), double(4))


def counter():
    count = 0

    def up(by=1):
        nonlocal count
        count += by
        return count
    return up


up = counter()
up()
print(up(5), reduce(lambda a, b: a * b, range(1, 6)), list(map(lambda a, b: a - b, [5, 6], [1, 2])))


def countdown(n):
    try:
        while n:
            got = yield n
            n = got if got is not None else n - 1
        return "done"
    finally:
        print("closed")


def outer():
    result = yield from countdown(2)
    yield result


print(list(outer()))
down = countdown(9)
print(next(down), down.send(3), next(down))
down.close()


def attempts():
    for attempt in range(4):
        try:
            if attempt == 0:
                continue
            if attempt == 1:
                raise Stop("one", code=7)
            if attempt == 2:
                return "returned"
        except Stop as stop:
            print("stop", stop, stop.code)
        else:
            print("never here")
        finally:
            print("finally", attempt)


print(attempts())
try:
    try:
        int("x")
    except ValueError as error:
        raise Stop("outer") from error
except (KeyError, Stop) as error:
    print(repr(error), str(error))
try:
    assert 1 > 2, "one is less"
except AssertionError as error:
    print(error)
x: float = 0.5
x, y = y, x = (1, 2)
print(x, y, 3 if x else 4, x < y < 3, not x == y, [1, 2] + [3] * 2, "a" "b", 1 if () else 2)
first, *middle, last = range(6)
(a, b), c = [(1, 2), 3]
print(first, middle, last, a, b, c, (n := 5) + n)
shapes[1].area(2)
