"""Letters of every language are made large and small, and what a value is."""

for text in ("Grün, größer", "ÉTÉ à Nîmes", "señor Ñ", "abc XYZ 5b", "ΑΒΓ кот", ""):
    print([text.upper(), text.lower(), text.capitalize(), text.swapcase(), "x" + text.upper()[1:]])
print("élan vital".title(), "it's 2nd".title(), str.upper("a"), list(map(str.lower, "AB")))
print(("ü" * 12000).upper() == "Ü" * 12000, b"ab".upper())
print(isinstance(True, int), isinstance(1, bool), isinstance(True, (str, float)), isinstance(False, (str, int)), isinstance("a", str))
try:
    {"x": 1}["missing"]
except KeyError as error:
    print("KeyError", error, str(error), f"{error}", repr(error), [error])
try:
    {}[(1, "b")]
except KeyError as error:
    print(error, error.args)
print(["Grün", "\n\t\\", "it's ü", "\"ü\"", "\"it's ü\"", "\x00\x1b\xa0"], {"ä": "кот"}, repr("日本"))
"5".upper() + 5
