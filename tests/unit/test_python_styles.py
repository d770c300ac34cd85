"""A program in any style does the same with the marks that the page puts into it, and all that runs has a mark."""

import ast
import random
import re
from operator import methodcaller

from differential import in_one_statement
from javascript import needs_node
from program_node import run_text, translate
from random_texts import random_text
from restyled import restyled

from conftest import ROOT

pytestmark = needs_node
LANGUAGE, NODES = ([file.read_text() for file in (ROOT / folder).glob("*.py")]
                   for folder in ("tests/programs/language", "tests/nodes"))
STYLES = 3  # of each program
UNMARKED = ast.Try, ast.With, ast.FunctionDef, ast.ClassDef  # but their statements
MARK = re.compile(r"\b_(?:at|each)\((\d+)")


def method(name):
    return lambda value, *given, **named: methodcaller(name, *given, **named)(value)


def functions(marked):
    """Return what a marked program calls: its marks, and what stands for what MicroPython lacks."""
    return {**{name: method(name[len("_py_"):]) for name in re.findall(r"\b_py_\w+", marked)},
            "_at": lambda line, **variables: None, "_each": lambda line, values: values, "_py_str": str,
            "_py_repr": repr, "_py_list": lambda *items: list(items), "_py_set": lambda *items: set(items),
            "_py_tuple": lambda *items: items, "_py_step": lambda value, *bounds: value[slice(*bounds)],
            "_py_dict": lambda *parts: {key: value for part in parts for key, value in part.items()}}


def lines(text, *without):
    """Return the lines of a program's statements, but of these kinds."""
    return {node.lineno for node in ast.walk(ast.parse(text))
            if isinstance(node, ast.stmt) and not isinstance(node, without)}


def marked(programs):
    """Yield each program in some styles, and the same with marks."""
    texts = {f"{number} {style}": restyled(program, style) for number, program in enumerate(programs)
             for style in range(STYLES)}
    for name, page in translate("marked", programs=texts).items():
        assert page["problem"] is None, texts[name]
        yield texts[name], page["marked"]


def test_a_program_in_any_style_does_the_same_with_marks():
    for text, page in marked(LANGUAGE + list(map(random_text, range(40)))):
        with_marks, plain = run_text(page, functions(page)), run_text(text)
        assert with_marks.trace == plain.trace, page
        assert type(with_marks.error) is type(plain.error), page
        places = {*with_marks.lines[-1:], *plain.lines[-1:]}
        assert len(places) < 2 or in_one_statement(text, *places), page


def test_each_line_with_a_statement_has_its_mark_and_keeps_its_number():
    examples = [page["python"] for page in translate("examples").values()]
    for text, page in marked(LANGUAGE + NODES + examples + list(map(random_text, range(10)))):
        marks = set(map(int, MARK.findall(page)))
        assert lines(text, UNMARKED) <= marks <= lines(text), page
        assert lines(page) == lines(text), page


def test_a_text_with_typing_errors_gets_its_marks_and_python_says_what_is_wrong():
    draw, texts = random.Random(1), {}
    rows = [row for text in LANGUAGE + NODES for row in text.splitlines()]
    for number in range(1000):
        start = draw.randrange(len(rows))
        text = "\n".join(rows[start:start + 6])
        for _ in range(3):
            place = draw.randrange(len(text) + 1)
            text = text[:place] + draw.choice(["", ";", "for ", "while ", "[", "(", ":", "\n"]) + text[place + 2:]
        texts[str(number)] = text
    for name, page in translate("marked", programs=texts).items():
        assert page["marked"].count("\n") == texts[name].count("\n"), texts[name]
