"""The teacher's guide and the list of lessons have each lesson.

What the lessons in a browser print in bold is on the page, in each language that they are in.
"""

import re
from functools import lru_cache

import pytest
from languages import keys, messages, read

from conftest import ROOT

IN_THE_PAGE = ["phone.md", "tablet.md", "python_tablet.md"]
PAGES = [*IN_THE_PAGE, *(page.name for page in (ROOT / "docs/lessons").glob("[0-9]*.md"))]
LESSONS = ROOT / "docs/lessons"
IN_A_BROWSER = {code: LESSONS / code.replace("en", "") for code in ("en", "de", "es")}
FORM = re.compile(r"^(#+ |\||!\[| *- |\d\. |<details>|</details>|<br>)", re.MULTILINE)
CODE = re.compile(r"```\w*\n(.*?)```|`([^`]+)`|<code>(.*?)</code>", re.DOTALL)


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
