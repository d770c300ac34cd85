"""The teacher's guides have each lesson, and quote what the software says.

What the lessons in a browser print in bold is on the page, in each language that they are in.
"""

import ast
import re
from functools import lru_cache

import pytest
from languages import keys, messages, read

from conftest import ROOT, SOURCE, TASKS

GUIDE, REAL_ROBOTS = ((ROOT / "docs" / name).read_text() for name in ("teaching.md", "fleet.md"))
IN_THE_PAGE = ["phone.md", "tablet.md", "python_tablet.md"]
PAGES = [*IN_THE_PAGE, *(page.name for page in (ROOT / "docs/lessons").glob("[0-9]*.md"))]
SAYS = ["the software says"], ["it says"]  # the second heads of tables


def tables_of(text):
    """Return the tables of a page, each as rows of cells."""
    return [[[cell.strip() for cell in line.strip("|").split(" | ")] for line in table.splitlines()]
            for table in re.findall(r"(?:^\|.*\|\n)+", text, re.MULTILINE)]


TABLES = tables_of(GUIDE)
SAID = [row[1] for table in [*TABLES, *tables_of(REAL_ROBOTS)] if table[0][1:2] in SAYS for row in table[2:]]
QUOTES = sorted({quote.strip("`") for quote in SAID if quote.startswith("`")})  # others are ROS's, a shell's ...
LESSONS = ROOT / "docs/lessons"
IN_A_BROWSER = {code: LESSONS / code.replace("en", "") for code in ("en", "de", "es")}
FORM = re.compile(r"^(#+ |\||!\[| *- |\d\. |<details>|</details>|<br>)", re.MULTILINE)
CODE = re.compile(r"```\w*\n(.*?)```|`([^`]+)`|<code>(.*?)</code>", re.DOTALL)
FIELD = "\0"


def texts_of(source):
    """Return the texts in a Python program, FIELD in place of what differs."""
    for node in ast.walk(ast.parse(source)):
        if isinstance(node, ast.JoinedStr):
            yield "".join(part.value if isinstance(part, ast.Constant) else FIELD for part in node.values)
        elif isinstance(node, ast.Constant) and isinstance(node.value, str):
            yield node.value


@pytest.fixture(scope="module")
def texts():
    """All texts of the programs and pages of which pupils see some."""
    files = [file for folder in ("src", "scripts") for package in (*SOURCE.parent.iterdir(), TASKS)
             for file in (package / folder).rglob("*.py")] + [*(ROOT / "docs").glob("*.py")]
    pages = [page for each in ("www/*.js", "www/program/*.js", "www/python/*.js", "fleet/*.sh")
             for page in sorted(SOURCE.parent.rglob(each))]
    scripts = "".join(page.read_text() for page in pages)
    return [*(text for file in files for text in texts_of(file.read_text())), *scripts.splitlines()]


@pytest.mark.parametrize("quote", QUOTES)
def test_the_software_says_each_quoted_sentence(quote, texts):
    fixed = [part.strip(" .:;,") for part in quote.split("...") if part.strip(" .:;,")]
    pattern = re.compile(".*".join(map(re.escape, fixed)), re.DOTALL | re.IGNORECASE)  # some begin after a prefix
    assert max(map(len, fixed)) > 8
    assert any(map(pattern.search, texts))


@pytest.mark.parametrize("listing, folder, cells", [
    ("docs/teaching.md", "lessons/", "minutes in each plan"), ("docs/lessons/README.md", "", "you learn")])
def test_the_plan_and_the_list_have_each_lesson_with_its_title(listing, folder, cells):
    rows = re.findall(rf"^\| \[([^\]]+)\]\({folder}(\w+\.md)\) \|", (ROOT / listing).read_text(), re.MULTILINE)
    linked = {page: title for title, page in rows}
    titles = {page: (ROOT / "docs/lessons" / page).read_text().splitlines()[0] for page in PAGES}
    numbered = {page: re.sub(r"^# (?:Lesson (\d+):)?", r"\1.", title).strip(". ") for page, title in titles.items()}
    for page, title in numbered.items():
        row = f"| [{title}]({folder}{page}) | {cells} |"
        assert linked.pop(page, None) == title, f"write into {listing}: {row}"
    assert not linked, f"delete from {listing} what is no lesson"


def quotes_of(page):
    """Return what a lesson quotes of the page: what is in bold, but its own sentences and what is one letter."""
    text = " ".join(page.read_text().split())
    own = [quote for quote in re.findall(r"\*\*(.*?)\*\*", text) if not re.search(r"[.?]$|^.$", quote)]
    return [*own, *re.findall(r"<b>(.*?)</b>", text)]


@lru_cache(maxsize=None)
def form_of(text):
    """Return how a text begins, whether it is a block's, and a pattern that it is with its values, or None."""
    first, *others = re.split(r"(?: ?%\d)+ ?", text.lstrip("▶ "))
    parts = [first, *others] if others else re.split(r"\{\w+\}", first)
    has_words = any(parts) if others else re.search(r"\w{4}", "".join(parts))  # others have only values, and say all
    return first, bool(others), re.compile(".+".join(map(re.escape, parts))) if has_words else None


def says(text, quote):
    """Return whether the page says this: a text with its values, or a block with its own, or how a block begins."""
    first, is_block, pattern = form_of(text)
    begins = f"{first} ".startswith(f"{quote} ") if is_block else first == quote
    return begins or pattern is not None and pattern.fullmatch(quote)


@pytest.mark.parametrize("quote", sorted({quote for quote in re.findall(r"\*\*([^*]+)\*\*", REAL_ROBOTS)
                                          if quote[-1] not in ".,:"}))  # others begin a paragraph
def test_the_page_says_what_the_guide_for_real_robots_has_in_bold(quote):
    assert any(says(english, quote) for english, _ in said_on("en"))


def said_on(code):
    """Return the texts of the pages, each as (English, in this language)."""
    english, theirs = messages("en"), messages(code)
    ours = {key: key for key in keys("en")} if code == "en" else read(code)
    return [*ours.items(), *((english[name], theirs[name]) for name in english)]


@pytest.mark.parametrize("name", IN_THE_PAGE)
@pytest.mark.parametrize("code", IN_A_BROWSER)
def test_the_page_says_in_its_language_what_the_english_lesson_quotes_and_nothing_else(code, name):
    def meaning(quote, column):
        numbers = re.findall(r"\d[\d.]*", quote.replace(",", "."))
        return {(english, *numbers) for english, *theirs in said if says([english, *theirs][column], quote)}
    said = said_on(code)
    wanted = {quote: meaning(quote, 0) for quote in quotes_of(LESSONS / name)}
    quoted = {quote: meaning(quote, 1) for quote in quotes_of(IN_A_BROWSER[code] / name)}
    assert len(wanted) > 1
    assert [quote for quote in wanted if not any(wanted[quote] & each for each in quoted.values())] == []
    assert [quote for quote in quoted if not any(quoted[quote] & each for each in wanted.values())] == []


@pytest.mark.parametrize("name", IN_THE_PAGE)
@pytest.mark.parametrize("code", ["de", "es"])
def test_a_translated_lesson_has_the_form_and_the_code_of_the_english_one(code, name):
    theirs, english = (IN_A_BROWSER[each] / name for each in (code, "en"))
    assert FORM.findall(theirs.read_text()) == FORM.findall(english.read_text())
    assert code_of(theirs) == code_of(english)


def code_of(page):
    """Return all code of a lesson, sorted; line breaks count as spaces."""
    return sorted(" ".join("".join(found).split()) for found in CODE.findall(page.read_text()))
