"""The table of a class's robots."""

from typing import List

from jetbot.text import printable

from .asking import Answer

HEADS = "robot", "address", "version", "battery", "link", "state"
SHORT = 8  # digits of a commit


def battery(answer: Answer) -> str:
    """Return the battery's voltage and charge, or "" if they are not measured."""
    facts = answer.state.get("health") or [] if answer.state else []
    said = next((fact["arguments"] for fact in facts if fact["code"] == "battery"), None)
    return f"{said['volts']} V, {said['percent']} %" if said else ""


def row(answer: Answer) -> List[str]:
    """Return what the table says of a robot, a text for each of HEADS."""
    delay = "" if answer.delay is None else f"{1000 * answer.delay:.0f} ms"
    entry = answer.entry
    address = entry.address if answer.address in ("", entry.authority) else answer.address
    cells = (entry.name, address, answer.version[:SHORT], battery(answer), delay, answer.text())
    return [printable(cell) for cell in cells]


def table(answers: List[Answer]) -> str:
    """Return the lines of all robots."""
    rows = [list(HEADS), *map(row, answers)]
    widths = [max(map(len, column)) for column in zip(*rows)]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(cells, widths)).rstrip() for cells in rows)
