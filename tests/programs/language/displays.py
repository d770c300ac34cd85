"""What MicroPython lacks of the forms of lists, texts and functions."""

numbers = [3, 1, 2]
text = "abcdefg"
print([*numbers, 4], [0, *numbers, *numbers], (*numbers, "x"), sorted({*numbers, 9}), [*"abc"])
print({**{"a": 1}, "b": 2}, {"x": 0, **{"a": 1}, **{"x": 5}}, {"k": {**{"deep": [*numbers]}}})
print(text[::-1], text[::2], text[5:1:-2], text[1:6:3], numbers[::-1], tuple(numbers)[::-1], text[:4:2], text[3::-1])
print(text[::-1][::-1], [*text][::-1], f"{text[::-1]} {text.title()}", f'{text[::-1]:>9} {text.title()!r:^12}')
for letter in text[::-3]:
    if letter[::-1].title() == "G":
        print(letter, "is the last")
while text[::-1][0] != "c":
    text = text[:-1]
print("hello WORLD 3times it's".title(), "hello World".capitalize(), "Abc".swapcase(), "".title(), "x".capitalize())
print("[" + "abc".ljust(6, ".") + "|" + "abc".rjust(6) + "|" + "42".zfill(5) + "|" + "-7".zfill(4) + "|" + "toolong".zfill(3))
print(["ab".center(width) for width in range(7)], ["a".center(width, "*") for width in range(5)], "abc".center(6, "-"))
print((2.0).is_integer(), (2.5).is_integer(), format(3.14159, ".2f"), format(42), format("x", ">4"), format(7, "03d"))


def move(x, *, z=0.0, seconds):
    return x, z, seconds


def rest(first, *others, last=0, **named):
    return first, others, last, named


print(move(1, seconds=2), move(0.5, z=0.1, seconds=3), rest(1, 2, 3, last=4, b=5, a=6), (lambda *, k=1: k)(k=2))
print(rest(*numbers, *text[::2], **{"last": 7}, **{"z": 1, "y": 2}))
numbers[0], *others = [*numbers, 5][::-1]
print(numbers, others)


class Title:
    def title(self, *names, center=0):
        return f"own {names} {center}"

    def center(self):
        return "own center"


own = Title()
own.zfill = lambda: "own zfill"
own.title.__class__
print(own.title(), own.title(*"ab", center=[*"c"]), own.center(), own.zfill())
grid = [[0] * 3 for _ in range(2)]
grid[1][::2]
print(grid[1][::2], [row[::-1] for row in grid])
print(numbers[1:2:], text[::])
numbers[5].title()
