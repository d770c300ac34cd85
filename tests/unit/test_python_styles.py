"""A program in any style keeps its tree when the page puts its marks into it, and all that runs has a mark."""

import ast
import random

from javascript import needs_node
from program_node import translate
from random_texts import random_text
from restyled import restyled

from conftest import ROOT

pytestmark = needs_node
FILES = [file for folder in ("tests/programs", "tests/nodes") for file in (ROOT / folder).rglob("*.py")]
STYLES = 3  # of each program
UNMARKED = ("Try", "With", "FunctionDef", "ClassDef")  # but their statements


def is_none(node):
    return isinstance(node, ast.Constant) and node.value is None


class Plain(ast.NodeTransformer):
    """Makes the same of programs that mean the same to marks.js: {**{a: b}} is {a: b}; no error has a cause."""

    def visit_Dict(self, node):
        pairs = [next(zip(value.keys, value.values)) if key is None and isinstance(value, ast.Dict)
                 and len(value.keys) == 1 else (key, value) for key, value in zip(node.keys, node.values)]
        return self.generic_visit(ast.Dict([key for key, _ in pairs], [value for _, value in pairs]))

    def visit_Raise(self, node):
        node.cause = None if isinstance(node.cause, ast.Name) or is_none(node.cause) else node.cause
        return self.generic_visit(node)


class Unmarked(Plain):
    """Takes the marks out of a program, and what stands for what MicroPython lacks; collects the marked lines."""

    def __init__(self):
        self.lines = set()

    def mark(self, node, name):
        """Return what is marked by this call, if anything."""
        assert isinstance(node, ast.Call) and node.func.id == name, ast.dump(node)
        line, *marked = node.args
        assert all(each.arg == each.value.id for each in node.keywords), "a variable's own name"
        self.lines.add(line.value)
        return self.visit(marked[0]) if marked else None

    def visit_Expr(self, node):
        value = node.value
        if isinstance(value, ast.Call) and isinstance(value.func, ast.Name) and value.func.id == "_at":
            assert value.args[0].value == node.lineno
            return self.mark(value, "_at")
        return self.generic_visit(node)

    def visit_If(self, node):
        before, test = node.test.values
        self.mark(before, "_at")
        assert before.args[0].value == node.lineno
        node.test = test
        return self.generic_visit(node)

    visit_While = visit_If

    def visit_For(self, node):
        assert node.iter.args[0].value == node.lineno
        node.iter = self.mark(node.iter, "_each")
        return self.generic_visit(node)

    def visit_FormattedValue(self, node):
        is_marked = isinstance(node.value, ast.Call) and getattr(node.value.func, "id", "") == "_py_str"
        node.value = node.value.args[0] if is_marked else node.value
        return self.generic_visit(node)

    def visit_Call(self, node):
        self.generic_visit(node)
        name = getattr(node.func, "id", "")
        if not name.startswith("_py_"):
            return node
        name, args = name[len("_py_"):], node.args
        if name == "set":
            return ast.Set(args)
        if name in ("list", "tuple"):
            return (ast.List if name == "list" else ast.Tuple)(args, ast.Load())
        if name == "step":
            bounds = [None if is_none(each) else each for each in args[1:]]
            return ast.Subscript(args[0], ast.Slice(*bounds), ast.Load())
        if name == "dict":
            return self.visit_Dict(ast.Dict([None] * len(args), args))
        if name in ("str", "repr"):
            return ast.Call(ast.Name(name, ast.Load()), args, node.keywords)
        return ast.Call(ast.Attribute(args[0], name, ast.Load()), args[1:], node.keywords)

    def visit_arguments(self, node):
        node.vararg = None if node.vararg and node.vararg.arg == "_py_rest" else node.vararg
        return self.generic_visit(node)


def statements(tree):
    """Return each statement of a program: its kind and its line."""
    return [(type(node).__name__, node.lineno) for node in ast.walk(tree) if isinstance(node, ast.stmt)]


def test_a_program_in_any_style_has_the_same_tree_with_marks():
    programs = [file.read_text() for file in FILES] + list(map(random_text, range(40)))
    programs += [page["python"] for page in translate("examples").values()]
    texts = {f"{number} in style {style}": restyled(program, style) for number, program in enumerate(programs)
             for style in range(STYLES)}
    for name, page in translate("marked", programs=texts).items():
        text, marked = texts[name], ast.parse(page["marked"])
        unmarked, tree = Unmarked(), Plain().visit(ast.parse(text))
        same = unmarked.visit(marked)
        assert page["problem"] is None, text
        assert ast.dump(same) == ast.dump(tree), text
        assert statements(same) == statements(tree), "all lines keep their numbers"
        assert {line for kind, line in statements(tree) if kind not in UNMARKED} <= unmarked.lines, text


def test_a_text_with_typing_errors_gets_its_marks_and_python_says_what_is_wrong():
    draw, texts = random.Random(1), {}
    rows = [row for file in FILES for row in file.read_text().splitlines()]
    for number in range(1000):
        start = draw.randrange(len(rows))
        text = "\n".join(rows[start:start + 6])
        for _ in range(3):
            place = draw.randrange(len(text) + 1)
            text = text[:place] + draw.choice(["", ";", "for ", "while ", "[", "(", ":", "\n"]) + text[place + 2:]
        texts[str(number)] = text
    for name, page in translate("marked", programs=texts).items():
        assert page["marked"].count("\n") == texts[name].count("\n"), texts[name]
