"""Random programs in Python, such as pupils write: the same seed makes the same program."""

import random
import re
from typing import List

INT, FLOAT, STR, LIST, DICT, BOOL = "ifsldb"
NAMES = {kind: [f"{kind}{number}" for number in range(3)] for kind in (INT, FLOAT, STR, LIST, DICT)}
START = "\n".join(f"{names[number]} = {value}" for kind, names in NAMES.items() for number, value in enumerate(
    {INT: (7, -3, 12345678901234567890), FLOAT: (0.5, -2.25, 1e21), STR: ("'abc'", "'x y z'", "''"),
     LIST: ([3, 1, 2], [], [-5, 5, 0, 5]), DICT: ({"a": 1, "b": 2}, {}, {"x": -1})}[kind]))

LITERALS = {INT: "0|1|-4|10|3", FLOAT: "0.1|3.0|1e-7|-0.0|2.5", STR: "'a'|'b c'|'12'|'-3.5'", LIST: "[1, 2]|[]",
            DICT: "{'a': 5}", BOOL: "True|False"}


def forms(text: str) -> List[str]:
    """Return the forms in a text; | separates them if no space is beside it."""
    return re.split(r"(?<! )\|(?! )", re.sub(r"\n +", "", text))


# Forms of expressions by their kind; a letter in brackets is a smaller expression, a capital one a name.
EXPRESSIONS = {kind: forms(text) for kind, text in {
    INT: """({i} + {i})|({i} - {i})|({i} * {i})|({i} // {i})|({i} % {i})|(-{i})|abs({i})|len({s})|len({l})|len({d})
        |int({f})|round({f})|sum({l})|max({i}, {i})|min({l})|{l}[{i}]|{d}[{s}]|{d}.get({s}, {i})|int(str({i}))
        |({i} if {b} else {i})|{s}.count({s})|{s}.find({s})|{l}.count({i})|({i} & {i})|({i} | {i})|({i} ^ {i})
        |({i} << ({i} % 9))|({i} >> ({i} % 9))|ord({s}[0])|divmod({i}, {i})[1]|pow({i} % 9, {i} % 9)|{l}.index({i})
        |sorted({l})[0]|sum([each * 2 for each in {l}])|len(set({l}))|int({s})|f({i})|g({i}, k={i})|int({b})|(~{i})
        |len(list(range({i} % 7)))|next(iter({l}))|len({s}.split())|counter.count|counter.add({i})|hash({i} % 99)
        |bool({s}) + {i} % 5|int({f} // 1)|{l}[-1]|max({l}, key=lambda each: -each)|min({i}, {i}, {i})""",
    FLOAT: """({f} + {f})|({f} - {i})|({f} * {f})|({i} / {i})|({f} / {f})|({f} % {f})|({f} // {f})|float({i} % 9999)
        |abs({f})|round({f}, {i} % 4)|max({f}, {f})|math.sqrt({f})|round(math.sin({f} % 7), 9)|math.floor({f}) / 2
        |(-{f})
        |float(str({f}))|round(math.atan2({f}, {f}), 9)|sum({l}) / len({l})|math.radians({f} % 360)
        |math.fabs({f})|float({s})|math.pi|(2 ** -({i} % 5))|math.degrees({f} % 7)
        |math.copysign({f}, {f})|math.fmod({f}, 7.5)|({f} if {b} else {f})|round({f} * 100) / 100""",
    STR: """({s} + {s})|({s} * ({i} % 4))|str({i})|str({f})|repr({s})|{s}.upper()|{s}[{i}:]|{s}[:{i}]|{s}[::-1]|{s}[{i}]
        |'-'.join(sorted({d}))|f"{{{I}}} {{{F}:.2f}}"|f"{{{S}!r:>8}}:{{{I}:05d}}"|"%d %s" % ({i}, {s})|"%.3f" % {f}
        |"%5d:%-6s:" % ({i}, {s})|"{{}} {{}}".format({i}, {s})|"{{:>6.1f}}".format({f})
        |"{{0}}{{1}}{{0}}".format({s}, {i})
        |{s}.replace('a', {s})|{s}.strip()|str({l})|str({d})|','.join([str(each) for each in {l}])|str({b})|{s}.title()
        |({s} if {b} else {s})|"".join(reversed({s}))|{s}.split()[0]|{s}.center(9)|str(({i}, {s}))|"%s" % ({l},)
        |f"{{{F}:8.3f}}"|f"{{{I}:>6}}"|f"{{{I} % 99:+d}}"|f"{{{F}:e}}"|f"{{{F}:g}}"|"%g" % {f}|"%e" % {f}|hex({i} % 999)
        |bin({i} % 99)|chr(97 + {i} % 26)|str(type({i}))|type({f}).__name__|{s}.lower()|"%x" % ({i} % 999)|str(None)
        |f"{{{S}:*^9}}"|f"{{{F} % 1:.0%}}"|{s}.lstrip('a')|{s}.rjust(5)|{s}.zfill(4)|{s}.capitalize()
        |{s}.partition('b')[2]|str(tuple({l}))|str(range({i} % 9))|"%5.1f%%" % ({f} % 100)|f"{{{I}=}}"|{s}.ljust(6, '.')
        |repr({f})|str(set())|str({s}.encode())|f"{{{S}}}{{{I}}}"|str(-0.0 * {i})""",
    LIST: """[{i}, {i}]|({l} + {l})|sorted({l})|sorted({l}, reverse={b})|{l}[{i} % 3:]|{l}[::-1]|list(range({i} % 6))
        |[each + 1 for each in {l}]|[each for each in {l} if each > {i}]|list(map(abs, {l}))|list({d}.values())
        |({l} * 2)|list(filter(None, {l}))|[a * b for a, b in zip({l}, {l})]|list(reversed({l}))
        |sorted({l}, key=lambda e: (abs(e), e))
        |[n for n, _ in enumerate({l})]|list(gen({i} % 5))|[x for y in [{l}, {l}] for x in y]|[*{l}, {i}]
        |[first for first, *rest in [({i}, {i})]]|{l}[::2]|{l}[-2:]|list({l})|sorted(set({l}))
        |[int(c) for c in str({i} % 99)]
        |list(range({i} % 9, {i} % 9, -2))|{l}.copy()|[{i} for _ in range(2)]|[len(w) for w in {s}.split()]""",
    DICT: """dict({d})|{{**{d}, 'k': {i}}}|{{{s}: {i}}}|{{key: value + 1 for key, value in {d}.items()}}
        |dict(zip('abc', {l}))|dict(a={i}, b={i})|{{str(each): each for each in {l}}}|{d}.copy()""",
    BOOL: """({i} < {i})|({i} == {i})|({f} > {f})|({s} == {s})|({s} in {s})|({i} in {l})|({s} in {d})|not {b}
    |({b} and {b})
        |({b} or {b})|({l} == {l})|{s}.startswith({s})|isinstance({i}, int)|any({l})|all({l})|bool({l})
        |({i} <= {i} < {i})
        |{s}.isdigit()|({s} < {s})|({l} < {l})|({f} == {i})|({i} != {f})|callable(f)|({d} == {d})
        |any(each > 2 for each in {l})|{s}.endswith('c')|math.isnan({f})|math.isclose({f}, {f})|{s}.isalpha()""",
}.items()}
# Forms of statements; # is a block of them.
STATEMENTS = forms("""{I} = {i}|{F} = {f}|{S} = {s}|{L} = {l}|{D} = {d}|print({i}, {f}, {s})|print({l}, {d})
    |print({b}, {s}, sep='-')
    |{I} += {i}|{I} -= {i}|{F} *= {f}|{F} /= {f}|{S} += {s}|{L}.append({i})|{L}.sort()|{L}.insert(0, {i})|{L}.pop()
    |{L}.extend({l})|{L}.remove({i})|{L}[0] = {i}|{D}[{s}] = {i}|del {D}[{s}]|{D}.update({d})|{D}.pop({s})|{L}.reverse()
    |{I}, {F} = {i}, {f}|{I}, *{L} = {l}|if {b}:#|if {b}:#else:#|if {b}:#elif {b}:#else:#|for {I} in {l}:#
    |for {I} in range({i} % 5):#
    |for {S} in {d}:#|for {I}, {S} in enumerate({s}):#|for {S} in {s}[:3]:#|for {I} in range({i} % 3):#else:#
    |try:#except Exception as e: print(type(e).__name__)
    |try:#except (ValueError, KeyError):#except ZeroDivisionError:#else:#finally:#
    |try:#finally:#|while {I} > 0 and counter.left():#{I} -= 3|print(f({i}))|assert {b}, {s}
    |{L} = [{i} for {I} in {l}]|{I} //= {i}
    |print({f}, end=' ')|print(*{l})|{I} **= 2; {I} %= 1000|print({d}.items())|print(list({d}.keys()), {f})
    |{L}[1:2] = {l}
    |raise ValueError({s})|print(sorted({d}.items()))|print("%s %r" % ({s}, {f}))|print({s} % {i})|{L}.clear()|pass
    |print({f})
    |print(h({i}, {l}))|print(min({f}, {f}), {i})|if {b}: print({i})|print(counter)|print({f} < {i} or {s})
    |print(repr({l}), {f})
    |print({i} + {s})|print({s}[{s}])|print({l}.foo)|print(undefined)|print(f({i}, {i}))|print(len({i}))
    |print({d}[{i}])""")

FUNCTIONS = """import math


class Counter:
    def __init__(self, most):
        self.count, self.most = 0, most

    def left(self):
        self.count += 1
        return self.count < self.most

    def add(self, amount=1):
        self.count += amount % 3
        return self.count

    def __repr__(self):
        return f"Counter({self.count})"


def f(x):
    return x if x < 2 or x > 9 else f(x - 1) * x


def g(a, b=2, *rest, k=None, **others):
    return a * b + (k or 0)


def h(n, items):
    total = 0
    for index, each in enumerate(items):
        if index > n % 4:
            break
        if each % 2:
            continue
        total += each
    return total


def gen(n):
    for i in range(n):
        yield i * i


counter = Counter(9)
"""


class Writer:
    """Writes one program."""

    def __init__(self, seed: int):
        self.random = random.Random(seed)

    def program(self) -> str:
        """Return a program of several parts, of which each but the last may fail."""
        lines = []
        for _ in range(8):
            part = [f"    {line}" for line in self.statements(0)]
            lines += ["try:", *part, "except Exception as error:", "    print(type(error).__name__)"]
        return "\n".join([FUNCTIONS, START, *lines, *self.statements(0)]) + "\n"

    def statements(self, depth: int) -> List[str]:
        """Return the lines of some statements."""
        return [line for _ in range(self.random.randint(1, 3 if depth else 6)) for line in self.statement(depth)]

    def statement(self, depth: int) -> List[str]:
        """Return the lines of a statement."""
        forms = [form for form in STATEMENTS if "#" not in form or depth < 2]
        *heads, end = self.filled(self.random.choice(forms), 1).split("#")
        lines = []
        for head in heads:
            lines += [head, *[f"    {line}" for line in self.statements(depth + 1)]]
        inside = heads and not end.startswith("except")  # it ends a loop's round
        return lines + ([("    " if inside else "") + end] if end else [])

    def expression(self, kind: str, depth: int) -> str:
        """Return an expression of this kind."""
        if self.random.random() < 0.35 * depth:
            return self.random.choice(NAMES.get(kind, []) + LITERALS[kind].split("|"))
        return self.filled(self.random.choice(EXPRESSIONS[kind]), depth)

    def filled(self, form: str, depth: int) -> str:
        """Return a form with names and smaller expressions in it."""
        return form.format_map(Expressions(self, depth + 1))


class Expressions(dict):
    """What stands for a letter in a form."""

    def __init__(self, writer: Writer, depth: int):
        super().__init__()
        self.writer, self.depth = writer, depth

    def __missing__(self, kind: str) -> str:
        if kind.isupper():
            return self.writer.random.choice(NAMES[kind.lower()])
        return self.writer.expression(kind, self.depth)


def random_text(seed: int) -> str:
    """Return the program of this seed."""
    return Writer(seed).program()
