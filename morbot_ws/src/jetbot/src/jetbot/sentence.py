"""A sentence for people as data: a code for programs, and a template with arguments that a page can translate."""

import json
from functools import lru_cache
from string import Formatter
from typing import Any, Dict, FrozenSet, Iterable, List, Mapping, NamedTuple, Optional, Tuple, Union

from .text import is_printable

MAX_TEXT = 500      # characters of a template, and of an argument, of another program
MAX_SENTENCES = 10  # of another program at once,
MAX_JSON = 4000     # and characters of them all


class Sentence(NamedTuple):
    """code: what programs know it by; template: in English, with {names}; arguments: what these stand for.

    An argument may itself be a sentence. Of two forms, "{count} robot|{count} robots", the argument ``count`` chooses:
    the first is for "1".
    """

    code: str
    template: str
    arguments: Mapping[str, Union[str, "Sentence"]] = {}

    def __str__(self) -> str:
        one, _, many = self.template.partition("|")
        return (many if many and self.arguments["count"] != "1" else one).format(**self.arguments)

    def fields(self) -> Dict[str, object]:
        """Return it as a part of a message."""
        arguments = {name: value.fields() if isinstance(value, Sentence) else value
                     for name, value in self.arguments.items()}
        return {"code": self.code, "arguments": arguments, "text": str(self), "template": self.template}


def row(table: Mapping[str, str], code: str, **arguments: object) -> Sentence:
    """Return the sentence with this code of a table of templates."""
    return Sentence(code, table[code], {name: value if isinstance(value, Sentence) else str(value)
                                        for name, value in arguments.items()})


def read_row(table: Mapping[str, str], code: str, values: Mapping[str, str]) -> Optional[Sentence]:
    """Return the sentence with this code, and with its arguments among some values; None if there is none."""
    names = names_in(table.get(code, ""))
    known = code in table and names <= values.keys()
    return Sentence(code, table[code], {name: values[name] for name in names}) if known else None


@lru_cache(maxsize=None)  # the pages' state asks for the same few many times a second
def names_in(template: str) -> FrozenSet[str]:
    """Return the names of the arguments of a template, which is a row of a table."""
    return frozenset(name for _, name, _, _ in Formatter().parse(template) if name)


def as_data(sentences: Iterable[Sentence]) -> List[Dict[str, Any]]:
    """Return {code, template, arguments} of each."""
    return [each._asdict() for each in sentences]


def dump(sentences: Iterable[Sentence]) -> str:
    """Return sentences without sentences in them as JSON."""
    return json.dumps(as_data(sentences))


def load(text: str) -> Optional[Tuple[Sentence, ...]]:
    """Return what another program has dumped; None if it is something else, or too much."""
    try:
        rows = json.loads(text) if len(text) <= MAX_JSON else None
    except (ValueError, RecursionError):
        return None
    if not isinstance(rows, list) or len(rows) > MAX_SENTENCES or not all(map(_is_sentence, rows)):
        return None
    return tuple(Sentence(**each) for each in rows)


def _is_sentence(value: Any) -> bool:
    """Return whether this is a sentence as data, whose texts a person may see."""
    if not isinstance(value, dict) or value.keys() != set(Sentence._fields):
        return False
    code, template, arguments = (value[name] for name in Sentence._fields)
    return isinstance(arguments, dict) and all(
        is_printable(each, MAX_TEXT) for each in (code, template, *arguments, *arguments.values()))
