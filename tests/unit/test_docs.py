"""The docs: each page is linked, each link has a target, each command exists, and what is generated is up to date."""

import re
import runpy

import pytest

from conftest import ROOT
from jetbot.boards import BOARDS
from jetbot_class.fleet.commands import parser as fleet_parser
from jetbot_class.robot.commands import parser as robot_parser

PARSERS = {"fleet": fleet_parser, "robot": robot_parser}
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
GENERATED = runpy.run_path(str(ROOT / "docs/tables.py"))["GENERATED"]
each_page = pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))


def rows(text):
    """Return the cells of all tables in a page, row by row."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]


def links(page):
    return re.findall(r"\]\(([^)\s]+)\)", page.read_text())


def heading_anchors(text):
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title).strip().lower().replace(" ", "-") for title in titles}


@each_page
def test_links_have_a_target(page):
    for target, _, anchor in (link.partition("#") for link in links(page)):
        if not target.startswith("http"):
            linked = page.parent / target if target else page
            assert linked.exists(), target
            assert not anchor or anchor in heading_anchors(linked.read_text()), f"{target}#{anchor}"


def test_readme_links_each_page():
    pages = {f"docs/{page.name}" for page in (ROOT / "docs").glob("*.md")}
    assert pages | {"CONTRIBUTING.md", "docs/lessons/README.md"} <= set(links(ROOT / "README.md"))


@pytest.mark.parametrize("file", GENERATED, ids=lambda file: file.name)
def test_what_is_generated_from_the_code_is_up_to_date(file):
    text, wanted = file.read_text(), GENERATED[file](file.read_text())
    assert text == wanted, f"{file} is not what its rows say: ./morbot shell docs/tables.py"


def test_every_board_is_explained():
    names = {row[0].split("`")[1] for row in rows((ROOT / "docs/boards.md").read_text()) if row[0].startswith("`")}
    missing = [f"| `{name}` | its maker's name | I2C, address 0x{board.address:02X} | {board.chip} |"
               for name, board in BOARDS.items() if name not in names]
    assert not missing, f"write into the table of docs/boards.md: {missing}"


@each_page
def test_the_commands_for_a_class_of_real_robots_exist_as_they_are_typed(page):
    text = page.read_text()
    typed = re.findall(r"`\./morbot\s+(fleet|robot)\b([^`]*)`", text) + \
        re.findall(r"^ *\./morbot (fleet|robot)\b(.*)$", text, re.MULTILINE)
    for command, arguments in typed:
        if "COMMAND" not in arguments:  # which stands for any
            PARSERS[command]().parse_args(arguments.split("#")[0].split())  # exits if it does not know them
