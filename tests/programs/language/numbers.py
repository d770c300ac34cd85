"""Numbers, and how they look."""

import math

print(7 // 2, -7 // 2, 7 % -3, -7 % 3, 7.5 // 2, -7.5 % 2, divmod(-7, 2), 2 ** 10, 2 ** -1, 2 ** 0.5, 10 ** 20, -2 ** 2)
print(1 / 3, 2 / 3, 10 / 4, 1e16, 1e15, 123456789.123, 1e-5, 0.0001, 0.1 + 0.2, 3.0, -0.0, 1e300 * 10, float("inf"), float("nan"))
print(round(2.5), round(3.5), round(-2.5), round(3.14159, 2), round(1234.5, -2), round(0.5), round(1.15, 1), round(7, 1))
print(int(3.9), int(-3.9), int("42"), int("  7 "), int("ff", 16), float("1e3"), float(" 2.5 "), bool(0.0), str(1.0), repr(0.1))
print(f"{3.14159:.2f} {3.14159:8.3f}|{3:5d}|{3:<5}|{3:^5}|{-3:+d}|{3:+}|{0.5:.0%}|{1234567.891:.2f}|{255:x}|{255:#x}|{5:08b}|{1e-9:g}|{12345.678:e}")
print("%d %i %5.2f %-8s| %+d %x %e %g %% %r %s" % (3, 4.7, 2.345678, "left", 5, 255, 12345.678, 0.0001, "q", [1, 2.5]))
print("{} {1} {0}".replace("{} ", "").format(1, 2), "{:.3f}".format(2 / 3), "{name}: {value:>6}".format(name="x", value=5))
print(abs(-3), min(3, 1, 2), max([4, 9, 2]), sum([1, 2]), sum([1, 2], 10), pow(2, 5), pow(2, 5, 7), max("b", "a"), min([], default=0))
print(math.pi, math.e, math.sin(1), math.cos(2), math.tan(0.5), math.atan2(1, -1), math.sqrt(2), math.degrees(1), math.radians(90))
print(math.floor(-1.5), math.ceil(1.2), math.trunc(-1.7), math.isclose(0.1 + 0.2, 0.3), math.gcd(12, 18), math.factorial(10))
print(math.hypot(3, 4), math.log(10), math.log10(1000), math.log2(8), math.exp(1), math.fabs(-2), math.copysign(1, -0.0), math.inf > 1)
print(2 ** 64, -(2 ** 70) // 3, 2 ** 100 % 97, 12345678901234567890 * 98765432109876543210, (1 << 40) >> 3, ~5, 6 & 3, 6 | 3, 6 ^ 3)
print(0x1F, 0b101, 0o17, 1_000_000, .5, 5., 1e3, True + True, 3 == 3.0, 1 < 2 < 3, 5 and 0 or "no", not 0, None is None)
print(hex(255), bin(10), oct(8), chr(65), ord("a"), int(True), complex(1, 2), list(range(10, 0, -3)), list(range(-3, 3)), len(range(0, 10, 3)))
total = 0.0
for i in range(20):
    total += 0.1
    print(total, end=" ")
print()
angle = 0.0
for i in range(8):
    angle += math.pi / 4
    print(f"{math.sin(angle):.3f} {math.cos(angle):+.3f}", round(angle, 4), sep="/", end="; ")
print("\n", [round(x * 0.1, 1) for x in range(12)], [x / 10 for x in range(-5, 6)])
print(int("4.5"))
