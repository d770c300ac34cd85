"""A program in another style, as another person would type it, with the same tree; a seed is a style."""

import ast
import io
import itertools
import random
import re
import tokenize
from typing import Iterator, List, NamedTuple

COMPOUND = re.compile(r"(?:if|elif|else|while|for|try|except|finally|with|def|class|async)\b|@")
COMMENTS = ["", " if x:", " )", " it's", " é = \"", " \\"]
INDENTS = ["    ", "\t", " ", "   "]


class Line(NamedTuple):
    """A logical line: how deep it is indented, and its tokens."""

    depth: int
    tokens: List[str]

    @property
    def is_simple(self) -> bool:
        return not COMPOUND.match(self.tokens[0])


def restyled(source: str, seed: int) -> str:
    """Return the program with other spaces, lines, comments and brackets."""
    draw = random.Random(seed)
    written = Writer(draw).written(list(lines_of(bracketed(source, draw))))
    return written.replace("\n", draw.choice(["\n", "\r\n"]))


def bracketed(source: str, draw: random.Random) -> str:
    """Return the program with more expressions in brackets."""
    rows, edits = source.encode().splitlines(keepends=True), []
    for node in expressions(ast.parse(source)):
        if draw.random() < 0.2:
            edits += [(node.lineno, node.col_offset, b"("), (node.end_lineno, node.end_col_offset, b")")]
    for line, column, bracket in sorted(edits, reverse=True):
        rows[line - 1] = rows[line - 1][:column] + bracket + rows[line - 1][column:]
    return b"".join(rows).decode()


def expressions(node: ast.AST) -> Iterator[ast.expr]:
    """Yield the expressions inside of this that may be in brackets; none in an f-string or a decorator."""
    never = [getattr(node, "func", None), getattr(node, "cause", None)]  # the page looks at their names
    for child in ast.iter_child_nodes(node):
        if isinstance(child, ast.JoinedStr) or child in getattr(node, "decorator_list", []):
            continue
        is_index = isinstance(node, ast.Subscript) and isinstance(child, ast.Tuple)
        is_value = isinstance(child, ast.expr) and isinstance(getattr(child, "ctx", ast.Load()), ast.Load)
        if is_value and not is_index and child not in never and not isinstance(child, (ast.Starred, ast.Slice)):
            yield child
        yield from expressions(child)


def lines_of(source: str) -> Iterator[Line]:
    """Yield the logical lines; a space before a token is a part of it, a comment is left out."""
    depth, tokens, end, strings = 0, [], (1, 0), []
    for token in tokenize.generate_tokens(io.StringIO(source).readline):
        kind = tokenize.tok_name[token.type]
        depth += (kind == "INDENT") - (kind == "DEDENT")
        if kind == "FSTRING_START":
            strings.append(token.start)
        elif kind == "NEWLINE":
            yield Line(depth, tokens)
            tokens = []
        start = strings.pop() if kind == "FSTRING_END" else token.start
        if not strings and kind not in ("NEWLINE", "NL", "COMMENT", "INDENT", "DEDENT", "ENDMARKER"):
            tokens.append(" " * bool(tokens and start != end) + between(source, start, token.end))
            end = token.end


def between(source: str, start: tuple, end: tuple) -> str:
    """Return the text between two places in the program: (line, column)."""
    rows = io.StringIO(source).readlines()[start[0] - 1:end[0]]
    rows[-1] = rows[-1][:end[1]]
    return "".join([rows[0][start[1]:], *rows[1:]])


def is_plain(lines: List[Line]) -> bool:
    """Return whether the block that begins here has only simple statements."""
    block = itertools.takewhile(lambda each: each.depth >= lines[0].depth, lines)
    return all(each.is_simple for each in block)


class Writer:
    """Writes one program."""

    def __init__(self, draw: random.Random):
        self.random, self.chance, self.indent = draw, lambda part: draw.random() < part, draw.choice(INDENTS)

    def written(self, lines: List[Line]) -> str:
        """Return the lines: some behind the one before, or behind the head of their block."""
        parts, inline = [], None  # inline: the depth of the block that is on the line of its head
        for number, (before, line) in enumerate(zip([None, *lines], lines)):
            if before and line.depth > before.depth and is_plain(lines[number:]) and self.chance(0.4):
                inline = line.depth
            if not before:
                gap = ""
            elif line.depth == inline:
                gap = self.random.choice(["; ", ";"] if before.depth == inline else ["", " "])
            elif line.depth == before.depth and before.is_simple and line.is_simple and self.chance(0.3):
                gap = self.random.choice([";", "; "])
            else:
                gap = self.end(before) + self.indent * line.depth
            inline = inline if line.depth == inline else None
            parts += [gap, self.joined(line.tokens)]
        return "".join(parts) + "\n"

    def end(self, line: Line) -> str:
        """Return the end of a line, and others that say nothing."""
        ends = [";"] * line.is_simple + ["", "", "\n", " ", self.comment(), "\n   " + self.comment()]
        return self.random.choice(ends) + "\n"

    def comment(self) -> str:
        return " #" + self.random.choice(COMMENTS)

    def joined(self, tokens: List[str]) -> str:
        """Return a logical line."""
        parts, depth = [tokens[0]], int(tokens[0] in "([{")
        for before, token in zip(map(str.strip, tokens), tokens[1:]):
            text = token.lstrip(" ")
            parts += [self.gap(before, token, depth), text]
            depth += (text in "([{") - (text in ")]}")
        return "".join(parts)

    def gap(self, before: str, token: str, depth: int) -> str:
        """Return what is between two tokens. depth: of brackets"""
        if self.chance(0.03) and before != "print":  # CodeMirror takes "print \\" for Python 2's
            return self.random.choice(["\n", self.comment() + "\n", "\n\t"] if depth else [" \\\n", "\t", "  "])
        text = token.lstrip(" ")
        needed = is_word(before[-1]) and is_word(text[0]) or before[0].isdigit()  # not 1if: MicroPython has none
        return token[:-len(text)] if needed else self.random.choice(["", "", token[:-len(text)], " "])


def is_word(character: str) -> bool:
    return character == "_" or character.isalnum()
