"""The lesson on Python, with a finger: from blocks to a text, mistakes, a loop and a function."""

import itertools
import time

import pytest

from jetbot.wait import wait_until

from .cockpit_page import TRY_AGAIN
from .conftest import ROBOT, TABLET, some
from .test_python_page import is_marked, marked
from .test_tablet_lesson import tap
from .world import TRIES

STRAIGHT, LEFT = (0.5, 0.5), (-0.1, 0.1)  # what the wheels get
BACKSPACE = "\ue003"
OUT = 3  # presses of it from a line in a loop to the end of the line above: two levels of spaces, and the line's end
COMMAND = "drive(0.5, 0, 3.33)"  # of the example
INDENT = " " * 4
# Below a colon, the editor indents
LOOP = "for count in range(4):\ndrive(0.5, 0, 1)\ndrive(0, 0.1, 1.47)"
SIDE = "def side(length):\ndrive(0.5, 0, length / 0.3)\ndrive(0, 0.1, 1.47)"
MISTAKES = [
    ("def main():", "def main():", "", 1, "A colon is missing: a line with “def” ends with :", "def main()"),
    (f"{INDENT}drive(0.5, 0, 1.67)", "drive", "vie", 3, "“drvie” is not known here. Do you mean drive?",
     f"{INDENT}drvie(0.5, 0, 1.67)"),
    (f"{INDENT}stop()", INDENT, " ", 0,
     "This line is indented too far: align it with the line above.", f"{INDENT} stop()"),
]
# Where a finger touches a line behind a text, "" being the empty line above main, or null if that is out of sight; and
# how far it is to scroll there, in px
PLACE = """const [line, part] = arguments, scroller = document.querySelector(".cm-scroller");
const { top, bottom, height } = scroller.getBoundingClientRect(), all = [...document.querySelectorAll(".cm-line")];
const found = line ? all.find(each => each.textContent.startsWith(line))
    : all[all.findIndex(each => each.textContent === "def main():") - 1];
if (!found) return [null, height / 2];
const walker = document.createTreeWalker(found, NodeFilter.SHOW_TEXT), range = document.createRange();
let left = found.textContent.indexOf(part) + part.length;
while (walker.nextNode() && left > walker.currentNode.length) left -= walker.currentNode.length;
if (line) range.setStart(walker.currentNode, left);
else range.selectNode(found);
const { x, y, height: letter } = range.getBoundingClientRect(), down = y + letter / 2;
return down > top + 12 && down < bottom - 12 ? [[x + 1, down], 0] : [null, down - (top + bottom) / 2];"""
CARET = """const { anchorNode, anchorOffset } = getSelection(), range = document.createRange();
const line = (anchorNode?.closest ? anchorNode : anchorNode?.parentElement)?.closest(".cm-line");
if (!line) return null;
range.setStart(line, 0);
range.setEnd(anchorNode, anchorOffset);
return range.toString();"""
SCROLLED = "return document.querySelector('.cm-scroller').scrollTop"


def drag(page, down):
    """Drag the text by so many px, and hold the finger still before it is lifted: the text does not glide on."""
    x, y = page.place_of(".cm-scroller")
    page.touch_event("touchStart", (x, y))
    for part in range(1, 11):
        page.touch_event("touchMove", (x, y + down * min(part, 8) / 8))
    page.touch_event("touchEnd")
    seen = [None, page.run(SCROLLED)]
    page.wait_for(lambda: seen[-2] == seen[-1] or seen.append(page.run(SCROLLED)), "the text to rest")


def touch(page, line, part):
    """Scroll until this line of the text is in sight, and touch it right behind this part of it, again if need be."""
    for _ in range(30):
        place, distance = page.run(PLACE, line, part)
        if not place:
            drag(page, max(-150, min(150, -distance)))
            continue
        page.touch_event("touchStart", tuple(place))
        page.touch_event("touchEnd")
        if wait_until(lambda: page.run(CARET) == line[:line.index(part) + len(part)], 0.5):
            return
    raise AssertionError(f"no caret behind {part!r} of {line!r}")


def type_text(page, text, delete=0):
    """Delete so many letters, and type with the tablet's keyboard."""
    for _ in range(delete):
        page.tap(BACKSPACE)
    for number, line in enumerate(text.split("\n")):
        if number:
            page.tap("Enter")
        if line:
            page.driver.execute_cdp_cmd("Input.insertText", {"text": line})


def change(page, line, old, new):
    """Replace a part of a line."""
    touch(page, line, old)
    type_text(page, new, delete=len(old))


def run(page, world, sentence="The program has ended."):
    """Touch Run, again if something paused; return what the wheels got until the page said this."""
    for _ in range(TRIES):
        start = time.time()
        page.run("document.getElementById('outcome').textContent = ''")  # of the run before
        tap(page, "#run")
        page.wait_for(lambda: page.text("outcome") not in ("", "Starting", "Running"), "the end", within=60)
        outcome = page.text("outcome")
        if outcome == sentence or not world.paused(page, start):
            break
        time.sleep(TRY_AGAIN)
    assert outcome == sentence
    world.wait_for_stop(ROBOT)
    driven = [tuple(round(each, 1) for each in speeds) for speeds in world.record.driven(ROBOT, start)]
    return [speeds for speeds, _ in itertools.groupby(driven) if any(speeds)]


@pytest.fixture
def page(page, world, request):
    """A tablet, lying unless the test says more, with the example One metre, which has become a text."""
    page.resize(*getattr(request, "param", TABLET))
    page.driver.get(f"{world.address}program")
    page.wait_for_link()
    page.choose(ROBOT)
    page.set("examples", "One metre")
    page.wait_for_text("python", COMMAND)
    tap(page, "#edit")
    page.wait_for(lambda: page.text("edit-question-yes") == "Edit as text", "the question")
    tap(page, "#edit-question-yes")
    page.wait_for(lambda: page.has("#text .cm-focused"), "the editor")
    assert not page.text("blocks") and page.element("map").is_displayed()
    return page


@pytest.mark.parametrize("page", some([TABLET, TABLET[::-1]], TABLET), indirect=True)
def test_from_blocks_to_text_a_number_and_mistakes_on_purpose(page, world):
    world.undisturbed(page, lambda: step_to(page, COMMAND))
    passed = [step(page) for _ in range(5)]
    assert passed[:3] == ["motion.linear.x = x", "motion.angular.z = z", "wait(seconds)"], "from main into drive"
    assert "end = rospy.get_time() + seconds" in passed, "and from there into wait"
    tap(page, "#end")
    change(page, INDENT + COMMAND, "3.33", "1.67")
    assert run(page, world) == [STRAIGHT]
    for line, part, typed, delete, sentence, failed in MISTAKES:
        touch(page, line, part)
        type_text(page, typed, delete)
        assert run(page, world, sentence) == []
        assert is_marked(page, "failed", failed)
        tap(page, "#text [title=Undo]")
        page.wait_for(lambda: not marked(page, "failed"), "the change to be taken back")


def step_to(page, line):
    """Touch Step, from the program's start on, until this line is marked."""
    if page.element("end").is_enabled():
        tap(page, "#end")
    assert any(step(page) == line for _ in range(20))


def step(page):
    """Touch Step; return the line that is marked then."""
    before = marked(page, "now")
    tap(page, "#step")
    page.wait_for(lambda: marked(page, "now") not in (None, before), "the next line")
    return marked(page, "now").strip()


@pytest.mark.long
def test_a_loop_and_a_function_with_a_parameter(page, world):
    change(page, INDENT + COMMAND, COMMAND, LOOP)
    assert run(page, world) == [STRAIGHT, LEFT] * 4, "a square"
    turn = f"{INDENT * 2}drive(0, 0.1, 1.47)"
    touch(page, turn, "drive")
    tap(page, "#text [title=Unindent]")
    assert run(page, world) == [STRAIGHT, LEFT], "straight on, then a turn"
    tap(page, "#text [title=Undo]")
    change(page, f"{INDENT * 2}drive(0.5, 0, 1)", "1", "count")
    assert run(page, world) == [LEFT, *[STRAIGHT, LEFT] * 3], "a spiral, whose first side has no length"
    touch(page, "", "")
    type_text(page, SIDE)
    change(page, f"{INDENT * 2}drive(0.5, 0, count)", "drive(0.5, 0, count)", "side(0.1 * count)")
    change(page, turn, turn.strip(), "")
    type_text(page, "", delete=OUT)
    assert run(page, world) == [LEFT, *[STRAIGHT, LEFT] * 3], "the same, by a function"
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
