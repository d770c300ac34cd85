"""The docs agree with the code, every page is linked, and every link has a target."""

import re

import pytest

from conftest import PACKAGES, ROOT
from jetbot.boards import BOARDS, scmd
from jetbot.boards.pwm_motors import ADAFRUIT, WAVESHARE, WAVESHARE_HAT
from jetbot.fake.bus import chips_of
from jetbot.fake.chips import INA219, PCA9685
from jetbot.guard import ANSWER_TIMEOUT
from jetbot.guard import process as guard
from jetbot.host import ROBOT_BUS, robot_bus
from jetbot_class.fleet.commands import parser as fleet_parser
from jetbot_class.robot.commands import parser as robot_parser
from jetbot_cockpit.session.lease import COMMAND_TIMEOUT
from jetbot_cockpit.session.messages import FROM_PAGE
from jetbot_control_node.parameters import PARAMETERS

PARSERS = {"fleet": fleet_parser, "robot": robot_parser}
PAGES = [*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md")]
BOARDS_PAGE, SAFETY_PAGE = ((ROOT / "docs" / name).read_text() for name in ("boards.md", "safety.md"))


def rows(text):
    """Return the cells of all tables in a page, row by row."""
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in text.splitlines() if line.startswith("|")]


def section(page, title):
    """Return the text below a heading, up to the next one of its level."""
    return page.split(f"## {title}\n")[1].split("\n## ")[0]


def numbers(text):
    """Return the numbers in a text, as a set."""
    return {float(number) for number in re.findall(r"\d+(?:\.\d+)?", text.replace(",", ""))}


def links(page):
    return re.findall(r"\]\(([^)\s]+)\)", page.read_text())


def heading_anchors(text):
    titles = re.findall(r"^#+ (.*)$", text, re.MULTILINE)
    return {re.sub(r"[^\w -]", "", title).strip().lower().replace(" ", "-") for title in titles}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_links_have_a_target(page):
    for target, _, anchor in (link.partition("#") for link in links(page)):
        if not target.startswith("http"):
            linked = page.parent / target if target else page
            assert linked.exists(), target
            assert not anchor or anchor in heading_anchors(linked.read_text()), f"{target}#{anchor}"


def test_readme_links_each_page():
    pages = {f"docs/{page.name}" for page in (ROOT / "docs").glob("*.md")}
    assert pages | {"CONTRIBUTING.md", "docs/lessons/README.md"} <= set(links(ROOT / "README.md"))


def test_every_board_is_explained():
    names = [re.match(r"`(\w+)`", row[0]) for row in rows(BOARDS_PAGE) if len(row) == 4]
    explained = {name[1] for name in names if name}
    assert explained <= set(BOARDS)
    missing = [f"| `{name}` | its maker's name | I2C, address 0x{board.address:02X} | {board.chip} |"
               for name, board in BOARDS.items() if name not in explained]
    assert not missing, f"write into the table of docs/boards.md: {missing}"


def test_the_address_of_the_voltmeter_on_a_fake_bus_is_that_of_the_pages(folder):
    chips = chips_of(folder, None, PCA9685)
    line = f"`~/.ros/fake_i2c/0x{next(each for each in chips if chips[each] is INA219):02x}` is an INA219"
    assert line in BOARDS_PAGE, f"write into docs/boards.md: {line}; and that address into docs/reference.md"


@pytest.mark.parametrize("board, wiring", [
    ("adafruit", ADAFRUIT), ("waveshare", WAVESHARE), ("waveshare_hat", WAVESHARE_HAT)])
def test_which_output_is_which_wheel(board, wiring):
    outputs = {row[1]: tuple(int(cell) if cell else None for cell in row[2:])
               for row in rows(BOARDS_PAGE) if row[0] == f"`{board}`" and row[1] in ("left", "right")}
    assert outputs == {"left": wiring.left, "right": wiring.right}


def test_the_picture_shows_these_outputs_and_their_registers():
    picture = (ROOT / "docs/boards.svg").read_text()
    used = [output for wiring in (ADAFRUIT, WAVESHARE) for bridge in wiring for output in bridge if output is not None]
    assert sorted(map(int, re.findall(r">(\d+)</text>", picture))) == sorted(used)
    assert sorted(re.findall(r">(0x\w\w)</text>", picture)) == sorted(
        [*(f"0x{6 + 4 * output:02x}" for output in used), "0x60", "0x60"])


def test_the_bus_of_each_computer():
    buses = {name: int(row[1][1]) for row in rows(BOARDS_PAGE) if re.match(r"`\d`", row[1])
             for name in row[0].split(", ")}
    assert buses == {name: robot_bus(name) for name in buses}
    missing = [part for part in ROBOT_BUS if not any(part in name.lower() for name in buses)]
    assert missing == ["jetson agx", "quill"]  # what Jetson Linux 32 calls an AGX Xavier and a TX2


def test_the_sequences_name_what_exists():
    page = (ROOT / "docs/design.md").read_text()
    rooms = re.findall(r"participant \w+ as (\w+)/(\S+)", page)
    assert rooms and all(any(PACKAGES.glob(f"{package}/**/{room}")) for package, room in rooms)
    assert set(re.findall(r"page->>session: (\w+)", page)) <= set(FROM_PAGE)
    assert all(hasattr(guard, name) for name in re.findall(r"(?:controller|guard)-.*: ([A-Z]+)\b", page))
    assert {guard.HEARTBEAT_TIMEOUT, ANSWER_TIMEOUT, COMMAND_TIMEOUT} == {
        float(seconds) for seconds in re.findall(r"(?:no|No).* for ([\d.]+) s", page)}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_the_commands_for_a_class_of_real_robots_exist_as_they_are_typed(page):
    text = page.read_text()
    typed = re.findall(r"`\./morbot\s+(fleet|robot)\b([^`]*)`", text) + \
        re.findall(r"^ *\./morbot (fleet|robot)\b(.*)$", text, re.MULTILINE)
    for command, arguments in typed:
        if "COMMAND" not in arguments:  # which stands for any
            PARSERS[command]().parse_args(arguments.split("#")[0].split())  # exits if it does not know them


@pytest.mark.parametrize("words, seconds", [
    ("heartbeat", guard.HEARTBEAT_TIMEOUT), ("`cmd_vel_timeout`", PARAMETERS["cmd_vel_timeout"].default),
    ("whole computer", scmd.TIMEOUT / 100), ("freeze the browser", COMMAND_TIMEOUT),
    ("browser lets go", COMMAND_TIMEOUT)])
def test_safety_page_has_the_times_of_the_code(words, seconds):
    row = next(" ".join(row) for row in rows(SAFETY_PAGE) if words in " ".join(row))
    assert seconds in numbers(row)
