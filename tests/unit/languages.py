"""The sentences that the pages show, in English, as keys of their translations."""

import json
import re
from html.parser import HTMLParser
from typing import Dict, Iterator, Set

from conftest import ROOT

WWW = ROOT / "morbot_ws/src/jetbot_cockpit/www"
CODES = sorted(file.stem for file in WWW.glob("languages/*.json"))
LITERAL = r'"(?:[^"\\]|\\.)*"'
CALL = re.compile(rf'\bt\(\s*({LITERAL}(?:\s*\+\s*{LITERAL})*)')
ATTRIBUTES = ("title", "aria-label", "aria-roledescription", "placeholder")


class Page(HTMLParser):
    """Collects what language.js translates in an HTML page."""

    def __init__(self, text: str):
        super().__init__()
        self.keys: Set[str] = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.keys.update(value for name, value in attributes if name in ATTRIBUTES)

    def handle_data(self, data):
        self.keys.add(" ".join(data.split()))


def in_scripts() -> Iterator[str]:
    """Yield each sentence that a script of the page translates."""
    for script in [*WWW.glob("*.js"), *WWW.glob("program/*.js")]:
        for call in CALL.finditer(script.read_text()):
            yield "".join(json.loads(literal) for literal in re.findall(LITERAL, call[1]))


def in_pages() -> Set[str]:
    """Return each text of the HTML pages."""
    return set().union(*(Page(file.read_text()).keys for file in WWW.glob("*.html")))


def keys() -> Set[str]:
    """Return all sentences that have letters."""
    return {key for key in {*in_scripts(), *in_pages()} if re.search(r"[^\W\d_]{2}", key)}


def read(code: str) -> Dict[str, str]:
    """Return the translations into a language, by their English."""
    return json.loads((WWW / f"languages/{code}.json").read_text())
