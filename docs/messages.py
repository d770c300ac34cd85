#!/usr/bin/env python3
"""Write the tables of protocol.md, and the types of the page, from the cockpit's table of messages.

Run it after a change to session/messages.py: ./morbot shell docs/messages.py
"""

import re
from pathlib import Path
from typing import Dict

from jetbot_cockpit.session.messages import FROM_COCKPIT, FROM_PAGE, PARTS, REQUESTS, Field, Form

PROTOCOL = Path(__file__).parent / "protocol.md"
TYPES = Path(__file__).parents[1] / "morbot_ws/src/jetbot_cockpit/www/messages.d.ts"


def table(kind: str, rows: Dict[str, Form]) -> str:
    """Return the table of messages. kind: the field that names one."""
    lines = [f"| `{kind}` | fields | meaning |", "|---|---|---|"]
    for name, row in rows.items():
        fields = ", ".join(f"`{each}`" + (f" ({field.range})" if field.range else "")
                           for each, field in row.fields.items())
        lines.append(f"| `{name}` | {fields} | {row.meaning}{'; teacher' if row.teacher else ''} |")
    return "\n".join(lines)


def parts() -> str:
    """Return the table of the objects that messages hold."""
    lines = ["| object | fields |", "|---|---|"]
    for name, fields in PARTS.items():
        described = ", ".join(f"`{each}` {field.type}" for each, field in fields.items()).replace("|", "or")
        lines.append(f"| `{name}` | {described} |")
    return "\n".join(lines)


def documented(text: str) -> str:
    """Return the text of protocol.md with its tables as they should be."""
    page, cockpit, objects, work = (table("type", FROM_PAGE), table("type", FROM_COCKPIT), parts(),
                                    table("do", REQUESTS))
    tables = iter([page, cockpit, objects, work])
    return re.sub(r"^\| (?:`type`|object|`do`) \|.*?(?=\n\n)", lambda _: next(tables), text, flags=re.M | re.S)


def members(fields: Dict[str, Field], optional: str = "") -> str:
    """Return fields as TypeScript declares them. optional: the mark of those that may be left out, "" for none."""
    return "".join(f" {name}{optional if field.type.endswith('null') else ''}: {field.type};"
                   for name, field in fields.items())


def types() -> str:
    """Return the types of all messages, in TypeScript."""
    lines = ["// The messages of the cockpit's socket. Written by docs/messages.py: do not change it by hand.", ""]
    lines += [f"export interface {name} {{{members(fields)} }}" for name, fields in PARTS.items()]
    for union, key, rows, optional in (("Outgoing", "type", FROM_PAGE, "?"), ("Incoming", "type", FROM_COCKPIT, ""),
                                       ("Request", "do", REQUESTS, "?")):
        lines += ["", f"export type {union} ="]
        lines += [f'  | {{ {key}: "{name}";{members(row.fields, optional)} }}' for name, row in rows.items()]
        lines[-1] += ";"
    return "\n".join(lines) + "\n"


if __name__ == "__main__":
    PROTOCOL.write_text(documented(PROTOCOL.read_text()))
    TYPES.write_text(types())
