"""Classes, properties, decorators, generators, exceptions and contexts, with the page's marks between them."""

import math


class Shape:
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


shapes = [Circle("c", 2), Circle("d", 0.5), Circle.unit()]
print(*[str(each) for each in sorted(shapes)], sep="; ")
print(Shape.count(), isinstance(shapes[0], Shape), min(shapes).name, getattr(shapes[1], "side", None))
shapes[0].radius = 3
print(shapes[0].radius, round(shapes[0].area(), 3))
try:
    shapes[0].radius = -1
except ValueError as error:
    print("error:", error, type(error).__name__, error.args)


class Vector:
    def __init__(self, x, y):
        self.x, self.y = x, y

    def __add__(self, other):
        return Vector(self.x + other.x, self.y + other.y)

    def __rmul__(self, factor):
        return Vector(self.x * factor, self.y * factor)

    def __eq__(self, other):
        return (self.x, self.y) == (other.x, other.y)

    def __repr__(self):
        return f"Vector({self.x}, {self.y})"

    def __iter__(self):
        yield self.x
        yield self.y

    def __call__(self, *given, **named):
        return given, named


v = Vector(1, 2) + 3 * Vector(0.5, 1)
print(v, v == Vector(2.5, 5), list(v), v(1, k=2), [v])


class Stop(Exception):
    def __init__(self, reason, code=3):
        super().__init__(reason)
        self.code = code


class Timer:
    def __enter__(self):
        return self

    def __exit__(self, kind, value, trace):
        print("exit", kind and kind.__name__, value)
        return kind is Stop


with Timer() as timer:
    print(type(timer).__name__)
    raise Stop("enough")


def repeated(times):
    def decorate(function):
        def inner(*given):
            return [function(*given) for _ in range(times)]
        return inner
    return decorate


def counter():
    count = 0

    def up(by=1):
        nonlocal count
        count += by
        return count
    return up


up = counter()
up()


@repeated(3)
def add(a, b=1):
    return a + b + up(5)


print(add(1), add(2, 3))


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
x: float = 0.5
x, y = y, x = (1, 2)
first, *middle, last = range(6)
(a, b), c = [(1, 2), 3]
print(x, y, first, middle, last, a, b, c, (n := 5) + n)
Shape("none").area()
