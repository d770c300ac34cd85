#!/usr/bin/env python3
"""Writes handouts.html: one page to print per lesson, made from docs/lessons."""

import argparse
import html
import re
from pathlib import Path
from typing import Iterator, List, NamedTuple, Tuple

LESSONS = Path(__file__).parent / "lessons"
ANSWER = re.compile(r"<details>.*?</details>\n*", re.DOTALL)
TYPED = re.compile(r"^Terminals? ([\d, and]+)(?:, (?:leave it running|with internet))?:\n\n```sh\n(.*?)```$",
                   re.MULTILINE | re.DOTALL)
TERM = re.compile(r"(?<![*\w])\*(\w[^*]*)\*(?!\*)")
ROWS = 4  # lines to write on below each question
PAGE = """<!DOCTYPE html>
<html lang="{language}"><head><meta charset="utf-8"/><title>{title}</title>
<style>
@page {{ margin: 9mm 16mm }}
html {{ background: #fff; color: #000 }}
body {{ max-width: 178mm; margin: 0 auto; font: 10.5pt/1.3 sans-serif }}
section {{ break-after: page; break-inside: avoid }}
section:last-child {{ break-after: auto }}
header {{ display: flex; justify-content: space-between; gap: 8mm; border-bottom: 0.6mm solid }}
header b {{ flex: 1; max-width: 70mm; font-weight: normal }}
h1 {{ margin: 0 0 1.5mm; font-size: 16pt }}
h2 {{ margin: 3mm 0 1mm; font-size: 12pt }}
p, ol {{ margin: 1.5mm 0 }}
code {{ font: 9.5pt/1.3 monospace; overflow-wrap: anywhere }}
table {{ width: 100%; border-collapse: collapse }}
th, td {{ padding: 0.8mm 2mm; border: 0.25mm solid; text-align: left }}
td:first-child code {{ white-space: nowrap }}
td:empty {{ min-width: 20mm; height: 6.5mm }}
hr {{ height: 5.5mm; margin: 0; border: 0; border-bottom: 0.25mm solid }}
</style></head><body>
{sections}
</body></html>
"""


class Words(NamedTuple):
    """The words of all handouts in a language, and those by which a lesson shows what is to be answered."""

    title: str
    name: str
    goal: str
    terms: str
    term: str
    meaning: str
    questions: str
    guess: str


WORDS = {
    "en": Words("Handouts: one page per lesson", "Name:", "You learn", "Words", "word", "what it means",
                "Exercise|Question", "your guess"),
    "de": Words("Arbeitsblätter: eine Seite je Lektion", "Name:", "Du lernst,", "Wörter", "Wort", "was es bedeutet",
                "Aufgabe|Frage", "deine Vermutung"),
    "es": Words("Hojas de trabajo: una página por lección", "Nombre:", "Aprendes", "Palabras", "palabra",
                "qué significa", "Ejercicio|Pregunta", "tu predicción"),
}


def inline(text: str) -> str:
    """Return Markdown of one paragraph as HTML: code, bold, italics, and the texts of links."""
    text = re.sub(r"\[([^\]]+)\]\([^)]*\)", r"\1", html.escape(text, quote=False))
    text = re.sub(r"`([^`]+)`", r"<code>\1</code>", text)
    text = re.sub(r"\*\*([^*]+)\*\*", r"<b>\1</b>", text)
    return TERM.sub(r"<i>\1</i>", text)


def table(rows: List[List[str]]) -> str:
    """Return a table; the first row is its head."""
    head, *body = rows
    return "<table>" + "".join(
        "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in row) + "</tr>"
        for tag, row in [("th", head), *(("td", row) for row in body)]) + "</table>"


def block(text: str) -> str:
    """Return a paragraph, a list or a table of Markdown as HTML, with space to write below."""
    lines = text.splitlines()
    if lines[0].startswith("|"):
        cells = [[inline(cell.strip()) for cell in line.strip("|").split("|")] for line in lines]
        return table([cells[0], *cells[2:]])
    if re.match(r"\d\. ", text):
        items = re.split(r"^\d\. ", text, flags=re.MULTILINE)[1:]
        return "<ol>" + "".join(f"<li>{inline(' '.join(item.split()))}<hr/></li>" for item in items) + "</ol>"
    return f"<p>{inline(' '.join(lines))}</p>"


def tasks(text: str, words: Words) -> Iterator[Tuple[str, str]]:
    """Yield the title and the text of each section with a question, and of one with guesses the table to fill in."""
    for section in re.split(r"^## ", text, flags=re.MULTILINE)[1:]:
        title, _, body = section.partition("\n")
        guesses = words.guess in body
        if guesses or re.match(words.questions, title):
            question = re.split(r"^<details>|^Terminal|^File|^```|^Next:", body, flags=re.MULTILINE)[0].strip()
            yield title, "\n".join(re.findall(r"^\|.*", body, re.MULTILINE)) if guesses else question


def commands(text: str) -> List[Tuple[str, str]]:
    """Return (terminal, command) for all that is typed, without the answers, each command once."""
    typed = {line: terminals for terminals, lines in TYPED.findall(ANSWER.sub("", text)) for line in lines.splitlines()}
    return [(terminals, line) for line, terminals in typed.items()]


def handout(page: Path, goal: str, words: Words) -> str:
    """Return the handout of a lesson. goal: what the reader learns. words: of the lesson's language."""
    text = page.read_text(encoding="utf-8")
    title = text.splitlines()[0].lstrip("# ")
    parts = [f"<header><h1>{inline(title)}</h1><b>{words.name}</b></header>"
             f"<p><b>{words.goal}</b> {inline(goal)}.</p>"]
    typed = commands(text)
    if typed:
        parts.append("<h2>You type</h2>" + table([["in", "command"], *(
            [terminals, f"<code>{html.escape(line)}</code>"] for terminals, line in typed)]))
    terms = list(dict.fromkeys(TERM.findall(ANSWER.sub("", re.sub(r"```.*?```", "", text, flags=re.DOTALL)))))
    if terms:
        parts.append(f"<h2>{words.terms}</h2>" + table([[words.term, words.meaning],
                                                        *([inline(term), ""] for term in terms)]))
    for name, body in tasks(text, words):
        parts.append(f"<h2>{inline(name)}</h2>" + "".join(map(block, re.split(r"\n{2,}", body)))
                     + ("" if "|" in body or "1. " in body else "<hr/>" * ROWS))
    return f'<section id="{page.stem}">{"".join(parts)}</section>'


def score_sheet() -> str:
    """Return a sheet for the scores of all driving tasks."""
    page = (LESSONS.parent / "tasks.md").read_text(encoding="utf-8")
    rows = re.findall(r"^\| (`\w+`) \| (.*?) \| [\d.]+ s \|", page, re.MULTILINE)
    head = ["task", "what to drive", "first", "second", "best", "where the best one lost most"]
    return ('<section id="tasks"><header><h1>Driving tasks</h1><b>Name:</b></header>'
            + table([head, *([inline(name), inline(what), "", "", "", ""] for name, what in rows)])
            + "<h2>My calculations</h2>" + "<hr/>" * 12 + "</section>")


def main(file: str = "handouts.html", language: str = "en") -> None:
    """Write the handouts of the lessons that are in this language; in English, with the sheet for the scores."""
    folder, words = "" if language == "en" else f"{language}/", WORDS[language]
    index = (LESSONS / "README.md").read_text(encoding="utf-8")
    goals = dict(re.findall(rf"^\| \[[^\]]*\]\({folder}(\w+)\.md\) \| (.*) \|$", index, re.MULTILINE))
    sections = [handout(LESSONS / folder / f"{page}.md", goal, words) for page, goal in goals.items()]
    sections += [score_sheet()] if language == "en" else []
    page = PAGE.format(language=language, title=words.title, sections="\n".join(sections))
    Path(file).write_text(page, encoding="utf-8")
    print(f"{file}: {len(sections)} handouts, one page each. Open it in a browser, and print it.")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("file", nargs="?", default="handouts.html")
    parser.add_argument("--language", choices=WORDS, default="en", help="of the lessons: %(choices)s")
    main(**vars(parser.parse_args()))
