"""A sentence for people as data: a code for programs, and a template with arguments that a page can translate."""

from string import Formatter
from typing import Dict, Mapping, NamedTuple, Optional, Set


class Sentence(NamedTuple):
    """code: what programs know it by; template: in English, with {names}; arguments: what these stand for.

    Of two forms, "{count} robot|{count} robots", the argument ``count`` chooses: the first is for "1".
    """

    code: str
    template: str
    arguments: Mapping[str, str] = {}

    def __str__(self) -> str:
        one, _, many = self.template.partition("|")
        return (many if many and self.arguments["count"] != "1" else one).format(**self.arguments)

    def fields(self) -> Dict[str, object]:
        """Return it as a part of a message."""
        return {"code": self.code, "arguments": self.arguments, "text": str(self), "template": self.template}


def row(table: Mapping[str, str], code: str, **arguments: object) -> Sentence:
    """Return the sentence with this code of a table of templates."""
    return Sentence(code, table[code], {name: str(value) for name, value in arguments.items()})


def read_row(table: Mapping[str, str], code: str, values: Mapping[str, str]) -> Optional[Sentence]:
    """Return the sentence with this code, and with its arguments among some values; None if there is none."""
    names = names_in(table.get(code, ""))
    known = code in table and names <= values.keys()
    return Sentence(code, table[code], {name: values[name] for name in names}) if known else None


def names_in(template: str) -> Set[str]:
    """Return the names of the arguments of a template."""
    return {name for _, name, _, _ in Formatter().parse(template) if name}
