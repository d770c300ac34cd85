"""The sentences that the pages show, in English, as keys of their translations."""

import json
import re
from html.parser import HTMLParser
from pathlib import Path
from typing import Dict, Iterator, List, Set

from driving_tasks.scoring.sentences import SENTENCES
from driving_tasks.scoring.tasks import TASKS
from jetbot.health import TEMPLATES
from jetbot_cockpit.notices import NOTICES
from jetbot_control_node.status.remarks import REMARKS
from jetbot_ros.state import CAUSES

WWW = Path(__file__).parents[1] / "morbot_ws/src/jetbot_cockpit/www"
CODES = sorted(file.stem for file in WWW.glob("languages/*.json"))
LITERAL = r'"(?:[^"\\]|\\.)*"'
CALL = re.compile(rf'\bt\(\s*({LITERAL}(?:\s*\+\s*{LITERAL})*)')
ATTRIBUTES = ("title", "aria-label", "aria-roledescription", "placeholder")
BLOCKLY = WWW / "vendor/blockly"
MESSAGE = re.compile(rf'Blockly\.Msg\["(\w+)"\] = ({LITERAL});')
SPOKEN = re.compile(  # Blockly's names of what it says to screen readers, and of the keys that it names
    "(?:ANNOUNCE|ARIA|BLOCK_LABEL|BUBBLE|CLOSE$|FIELD_LABEL|ICON|INPUT_LABEL|KEYBOARD_NAV|OPEN_TRASH|RESET|SCREENREADER"
    r"|WORKSPACE|ZOOM|\w*(?:_ANNOUNCEMENT|_ARIA|ALT_KEY|COMMAND_KEY|CONTROL_KEY|DELETE_KEY|ENTER_KEY|SHIFT_KEY)$)")
ABSENT = re.compile("COLLAPSED|COMMENT|CHECKBOX|IMAGE|LIST|ATAN2"  # which our blocks do not have
                    "|TEXT_(?!JOIN|INPUT)")


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
    for script in [file for folder in ("", "program/", "curves/", "python/") for file in WWW.glob(f"{folder}*.js")]:
        for call in CALL.finditer(script.read_text()):
            yield "".join(json.loads(literal) for literal in re.findall(LITERAL, call[1]))


def in_pages() -> Set[str]:
    """Return each text of the HTML pages."""
    return set().union(*(Page(file.read_text()).keys for file in WWW.glob("*.html")))


def templates() -> List[str]:
    """Return what Python says to a page, each template once."""
    said = [*NOTICES.values(), *CAUSES.values(), *REMARKS.values(), *SENTENCES.values(), *TEMPLATES]
    for task in TASKS.values():
        said += [task.title, task.invitation.template]
    return list(dict.fromkeys(said))


def in_blockly(code: str) -> Set[str]:
    """Return what Blockly says in English in this language: words.js translates it."""
    texts = "".join((BLOCKLY / f"{part}_compressed.js").read_text() for part in ("blockly", "blocks"))
    used, theirs = set(re.findall(r"(?:BKY_)?([A-Z][A-Z0-9_]+)", texts)), messages(code)
    return {text for name, text in messages("en").items() if theirs[name] == text
            and name in used and SPOKEN.match(name) and not ABSENT.search(name)}


def messages(code: str) -> Dict[str, str]:
    """Return Blockly's own texts in a language, by their names."""
    file = BLOCKLY / f"msg/{code}.js"
    assert file.exists(), f"write msg/{code}.js into jetbot_cockpit/fetch_blockly, and run it: {file} is missing"
    return {name: json.loads(text) for name, text in MESSAGE.findall(file.read_text())}


def keys(code: str) -> Set[str]:
    """Return all sentences that have letters, and that this language has to translate."""
    said = {*in_scripts(), *in_pages(), *in_blockly(code), *templates()}
    return {key for key in said if re.search(r"[^\W\d_]{2}", key)}


def read(code: str) -> Dict[str, str]:
    """Return the translations into a language, by their English."""
    return json.loads((WWW / f"languages/{code}.json").read_text())
