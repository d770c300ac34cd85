"""The page for programs drives a real robot, and whatever stops the robot ends the program."""

import functools
import signal
import subprocess
import time
from itertools import groupby

import pytest

from harness import START_TIMEOUT
from jetbot.fake.motors import STOPPED
from jetbot_lessons import lessons

from .conftest import OTHER_ROBOT, ROBOT
from .messages import TASKS
from .programs import block, chain, drive, let, num, plug, program, set_motion, show, var, wait
from .screens import DESKTOP, TOUCH_SCREENS
from .test_page import LISTEN
from .test_stop import release

FORWARD = (0.5, 0.5)
CHANGE = "Blockly.getMainWorkspace().getBlocksByType('math_number')[0].setFieldValue(2, 'NUM')"
TABLETS = [(768, 1024), (1024, 768), (1180, 820), (960, 540)]  # px; the last one is a projector's at 200 %
SMALL = [(320, 568), (844, 390), (640, 340), (400, 300)]
NOTE_LINES = """const { beginPath, lineTo } = CanvasRenderingContext2D.prototype;
    let [points, most] = [0, 0];
    Object.assign(CanvasRenderingContext2D.prototype, {
        beginPath() { points = 0; beginPath.call(this); },
        lineTo(...at) { most = Math.max(most, points += 1); lineTo.apply(this, at); },
    });
    window.longest = () => { const found = most; most = 0; return found; };"""  # points of a line on the map since then
CLEAR = """const { left, top, width } = document.getElementById(arguments[0]).getBoundingClientRect();
    const shown = document.elementFromPoint(left + width / 2, Math.max(top, 0) + 20);
    return shown.closest("#" + arguments[0]) !== null"""


def undisturbed(test):
    """Let a test do all again, from its program's start on, only if it fails and the page or this process paused."""
    @functools.wraps(test)
    def repeated(blocks, **fixtures):
        blocks.undisturbed(lambda: test(blocks=blocks, **fixtures))
    return repeated


def run(page, world, speeds=FORWARD, button="run"):
    """Run the program until the wheels turn at these speeds, as far as the chip's steps can tell."""
    world.hold(page, lambda: page.start_program(button), lambda: page.click("#end"), ROBOT,
               lambda *wheels: close(wheels, speeds))


def reload(page):
    page.driver.refresh()
    page.wait_for_link()
    page.choose(ROBOT)


def close(wheels, speeds):
    return all(abs(one - other) < 0.003 for one, other in zip(wheels, speeds))


@undisturbed
def test_a_program_drives_and_stops_at_its_end(blocks, world):
    page = blocks(program(drive(0.5, 1), block("robot_turn", {"SIDE": "LEFT"}, Z=num(0.3), SECONDS=num(0.5)),
                          show(plug("text", {"TEXT": "<b>done</b>"}))))
    start = time.time()
    run(page, world)
    page.wait_for_text("outcome", "The program has ended.")
    world.wait_for_stop(ROBOT)
    assert page.text("prints") == "<b>done</b>"
    driven = world.record.since(ROBOT, start)
    assert [speeds for speeds, _ in groupby(tuple(round(each, 1) for each in change.speeds) for change in driven)] == [
        FORWARD, (-0.3, 0.3), STOPPED]
    assert world.wheels(OTHER_ROBOT) == STOPPED
    assert [later.time - each.time for each, later in zip(driven, driven[1:])] == pytest.approx([1, 0.5], abs=0.05)


@undisturbed
def test_a_program_reads_its_robots_place_wheels_and_clock(blocks, world):
    until = block("controls_whileUntil", {"MODE": "UNTIL"}, BOOL=plug(
        "logic_compare", {"OP": "GTE"}, A=plug("robot_here", {"WHAT": "X"}), B=num(0.15)),
        DO=chain(wait(0.1), let("w", plug("robot_wheel", {"WHAT": "LEFT"}))))
    page = blocks(program(set_motion(0.5, 0), until, block("robot_stop"), show(var("w")),
                          show(plug("robot_time")), show(plug("robot_here", {"WHAT": "X"})),
                          show(plug("robot_eye", {"WHAT": "MIDDLE"})), variables="w"))
    run(page, world)
    page.wait_for_text("outcome", "The program has ended.")
    wheel, seconds, x, eye = map(float, page.text("prints").split())
    assert wheel == pytest.approx(0.5, abs=0.01)
    assert 0.4 < seconds < 5
    assert 0.14 < x < 0.4
    assert eye == 1, "there is no line"


LATE_STATUS = """const receive = socket.onmessage; socket.onmessage = ({data}) => {
    const message = JSON.parse(data);
    for (const robot of Object.values(message.type === 'state' && message.robots))
        Object.assign(robot, {status: 'driving', state: 'driving', cause: ''});
    receive({data: JSON.stringify(message)}); }"""


def freezes(page, world):
    try:
        page.signal(signal.SIGSTOP)
        world.wait_for_stop(ROBOT, "SIGSTOP of the browser")
    finally:
        page.signal(signal.SIGCONT)


ENDS = {
    "Stop": (lambda page, _: page.click("#end"), "Stopped."),
    "Escape": (lambda page, _: page.tap("Escape"), "Stopped."),
    "STOP of all robots": (lambda page, _: page.click("#stop"), "All robots were stopped."),
    "a stop from elsewhere": (lambda page, world: (page.run(LATE_STATUS), world.emergency_stop()), "All robots were"),
    "another tab": (lambda page, _: (page.new_tab(), page.old_tab()), "The page was hidden"),
    "a page that freezes": (freezes, "This page was interrupted"),
    "a change": (lambda page, _: page.run(CHANGE), "The program was changed."),
    "another robot": (lambda page, _: page.choose(OTHER_ROBOT), "Another robot was chosen."),
}


@undisturbed
def test_the_program_ends_and_the_robot_stops_at_any_stop_a_change_or_in_the_background(blocks, world):
    for name, (act, sentence) in ENDS.items():
        page = blocks(program(drive(0.5, 30)))
        page.choose(ROBOT)
        release(page)
        run(page, world)
        page.run(LISTEN)
        with world.stops(ROBOT, what=name):
            act(page, world)
        page.wait_for(functools.partial(page.run, "return said.join().includes(arguments[0])", sentence), sentence)


@undisturbed
def test_pause_and_step(blocks, world):
    page = blocks(program(drive(0.5, 0.6), let("x", num(3)), drive(-0.5, 30), variables="x"))
    page.click("#step")
    page.wait_for_text("outcome", "Paused")
    assert page.text_of("#python .now") == "drive(0.5, 0, 0.6)" and page.has(".robot_drive.blocklyHighlighted")
    run(page, world, button="step")
    page.wait_for(lambda: page.text_of("#python .now") == "x = 3", "the end of the step")
    world.wait_for_stop(ROBOT, "a step")
    page.click("#step")
    page.wait_for_text("variables", "3")
    run(page, world, (-0.5, -0.5), "pause")
    assert page.has("#bar .language:disabled"), "another language would load the page again"
    page.click("#pause")
    world.wait_for_stop(ROBOT, "Pause")
    page.click("#end")
    page.wait_for(lambda: page.has("#bar .language:enabled"), "languages to choose from")


@undisturbed
def test_a_program_that_asks_for_too_much_or_for_nothing_says_so_at_its_end_and_marks_the_block(blocks):
    for content, sentence, marked in (
            ([drive(3.33, 0.2), wait(0.1)], "The program has ended. A wheel takes 1 at most, not 3.33.", "drive"),
            ([], 'Nothing is below "when the program starts"', "start")):
        page = blocks(program(*content))
        page.click("#run")
        page.wait_for_text("outcome", sentence)
        assert page.has(f".robot_{marked} > .blocklyPassiveFocus")


@undisturbed
def test_a_forged_program_is_refused_markup_in_names_stays_a_name_and_a_thousand_blocks_are_kept(blocks):
    page = blocks(program(show(num(5))))
    blocks(program({**block("math_number_property"), "extraState": 5}))
    page.wait_for(lambda: page.text("notice").endswith("."), "a sentence")
    assert page.run("return Blockly.getMainWorkspace().getAllBlocks().length") == 3
    evil = "</svg><img src=x onerror=window.evil=1>\r\nimport os\nos.x()"
    blocks({**program(let("x", num(1)), show(plug("text", {"TEXT": evil})), wait(9)),
            "variables": [{"name": evil, "id": "x"}]})
    page.wait_for_text("python", "print(")
    page.click("#run")
    page.wait_for_text("prints", "</svg><img")
    assert not page.run("return window.evil || document.querySelector('img')")
    assert not [line for line in page.text("python").splitlines() if line.strip().startswith(("import os", "os."))]
    blocks(program(*[block("controls_repeat_ext", TIMES=num(1), DO=chain(*[drive(0.5, 1)] * 32))] * 10))
    page.wait_for(lambda: page.text("python").count("drive(0.5, 0, 1)") == 320, "the Python of all blocks")
    page.type("title", "Large")
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")


FINGER = 40  # px
NUMBER = ".blocklySvg .math_number .blocklyFieldRect"
NUMBER_BOXES = {"showEditor": "blocklyHtmlInput", "showPromptEditor": "blocklyDialogInput"}  # a computer's, Android's


def test_a_number_may_have_a_decimal_comma_and_is_large_enough_for_a_finger(blocks):
    for editor, field in NUMBER_BOXES.items():
        page = blocks(program(drive(0.5, 1)))
        page.wait_for_text("python", "drive(0.5, 0, 1)")
        for typed, x in ("0,7", 0.7), ("-,25", -0.25), ("1,2,3", -0.25):
            page.run(f"Blockly.getMainWorkspace().getBlocksByType('math_number')[0].getField('NUM').{editor}();"
                     f"document.querySelector('.{field}').select()")
            box = page.driver.switch_to.active_element
            assert box.get_attribute("inputmode") == "decimal" and box.size["height"] >= FINGER
            if editor == "showEditor":
                assert page.place_of(f".{field}") == pytest.approx(page.place_of(NUMBER), abs=2), "it opens elsewhere"
            box.send_keys(f"{typed}\n")
            page.wait_for_text("python", f"drive({x}, 0, 1)")
    size = page.driver.find_element("css selector", NUMBER).size
    assert min(size.values()) >= 32, "a finger does not hit it"


def test_the_map_shows_the_robot_the_tasks_world_and_the_trail_of_the_run_alone(blocks):
    page = blocks(program())
    page.driver.execute_cdp_cmd("Network.enable", {})
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": ["*/map.js"]})
    reload(page)
    page.receive({"type": "scene", "robot": f"/{ROBOT}", "shapes": [
        {"kind": "course", "width": 0.01, "points": [[0, 0], [1, 0]]},
        {"kind": "goal", "width": 0.2, "points": [[1, 0], [1.2, 0]]}]})
    page.click("#show-map")
    page.wait_for_text("notice", "This could not be loaded. Try again.")
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": []})
    page.click("#show-map")
    page.click("#show-map")
    assert not page.text("python")
    page.wait_for(page.robot_on_map, "the robot on the map")
    page.wait_for(lambda: page.shows_on_map("#7c3aed"), "the task's goal")
    page.run(NOTE_LINES)

    def act():
        for content, points in (drive(0.5, 1.5), range(9, 999)), (wait(0.3), range(1, 5)):
            blocks(program(content))
            page.click("#run")
            page.wait_for_text("outcome", "The program has ended.")
            page.wait_for(lambda points=points: page.run("return longest()") in points, "the trail of this run alone")
    blocks.undisturbed(act)
    page.click("#show-map")
    page.wait_for_text("python", "0.3")


@undisturbed
def test_the_name_that_is_typed_here_is_announced_after_a_reload_too(blocks, world, pupil):
    page = blocks(program())
    page.type("name", "Ada")
    reload(page)
    page.run("localStorage.removeItem('name')")
    run(blocks(program(drive(0.5, 30))), world)
    pupil.wait_for_text("driver", "Ada drives it")


def test_a_package_is_accepted_by_the_lessons_and_drives_the_same(blocks, world, tmp_path):
    page = blocks(program(drive(0.5, 0.8), set_motion(0.3, 0.1), wait(0.5),
                          show(plug("robot_here", {"WHAT": "HEADING"}))))
    page.set("title", "Two moves!")
    subprocess.run(["sh", page.download("package", "my_two_moves.txt"), tmp_path], check=True)
    folder = tmp_path / "my_two_moves"
    for lesson in 7, 8:
        assert lessons.find_problem(lessons.handed_in_package(folder)[lesson]) is None
    page.choose(OTHER_ROBOT)
    world.undisturbed(page, lambda: drives_as_its_node(page, world, folder))


def drives_as_its_node(page, world, folder):
    world.wait_until_free(OTHER_ROBOT)
    begin = time.time()
    node = world.start(str(folder / "scripts/program.py"), f"__ns:=/{OTHER_ROBOT}")
    assert node.wait(START_TIMEOUT) == 0
    world.wait_for_stop(OTHER_ROBOT)
    by_node, begin = world.record.driven(OTHER_ROBOT, begin), time.time()
    page.click("#run")
    page.wait_for_text("outcome", "The program has ended.")
    world.wait_for_stop(OTHER_ROBOT)
    assert world.record.driven(OTHER_ROBOT, begin) == by_node
    assert float(page.text("prints")) == pytest.approx(float(node.log.read_text()), abs=10)


IN_SIGHT = """const { top, bottom } = document.getElementById("python").getBoundingClientRect();
    return [...document.querySelectorAll("#python div")].filter((line) => {
        const box = line.getBoundingClientRect();
        return box.top >= top && box.bottom <= bottom;
    }).map((line) => line.textContent.trim())"""


def test_the_python_is_shown_from_the_pupils_own_part_on_unless_the_pupil_has_scrolled(blocks):
    page = blocks(program(drive(0.5, 1)))
    in_sight = functools.partial(page.run, IN_SIGHT)
    page.wait_for(lambda: {"def main():", "drive(0.5, 0, 1)"} <= set(in_sight()), "the program in sight")
    page.click("#show-map")
    page.resize(768, 1024)
    page.set("examples", "A square, with a function")
    page.click("#show-map")
    page.wait_for(lambda: in_sight()[0] == "def side():", "the pupil's function, on an upright tablet, after the map")
    page.tab_to("python")
    page.tap("Home")
    page.wait_for(lambda: in_sight()[0].startswith("#!"), "the beginning")
    before = page.text("python")
    page.run(CHANGE)
    page.wait_for(lambda: page.text("python") != before, "another program")
    assert in_sight()[0].startswith("#!")


MANY_PRINTS = """const prints = document.getElementById("prints");
    for (let count = 0; count < 30; count += 1) prints.append(document.createElement("li"), `line ${count}`);
    document.getElementById("output").scrollTop = 9999;"""
PLACES = """return ["There is a newer version of this program. ".repeat(2), "Not kept yet", ""].map((text) => {
    document.getElementById("kept").textContent = text;
    document.getElementById("newer").hidden = !text;
    return JSON.stringify(document.getElementById("blocks").getBoundingClientRect());
});"""
JUDGED = """scrollTo(0, 0);
    document.getElementById("outcome").textContent = "The program has ended. A wheel takes 1 at most, not 3.33.";
    document.getElementById("judge").click();"""
SCORE = "One metre: 94.5 points, 12.4 s. Largest loss: it ended 4 cm behind the goal, 2.3 points."


def test_whatever_is_said_the_blocks_do_not_move_outcome_and_score_are_in_sight_and_all_is_reached(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.receive(TASKS)
    page.run(MANY_PRINTS)
    for screen in TABLETS:
        page.resize(*screen)
        assert len(set(page.run(PLACES))) == 1, screen
        page.wait_for(lambda: not page.outside("#outcome", "#output"), f"the outcome on {screen}")
    for screen in [*TOUCH_SCREENS, DESKTOP]:
        page.resize(*screen)
        page.run(JUDGED)
        page.wait_for_text("score", "No judge has this task now")
        page.run("document.getElementById('score').textContent = arguments[0]", SCORE)
        page.wait_for(lambda: not page.outside("#outcome, #score", "#result") and page.fits("outcome", "score", "stop"),
                      f"outcome and score on {screen}")
        assert page.overlapping() == [], screen
    for screen in SMALL:
        page.resize(*screen)
        page.receive({"type": "notice", "text": "Somebody else drives the robot. " * 3})
        for name in "programs", "run", "end", "output", "blocks":
            page.run("document.getElementById(arguments[0]).scrollIntoView({block: 'center'})", name)
            page.wait_for(lambda name=name: page.run(CLEAR, name) and page.fits("stop", "release"),
                          f"{name} on {screen}")
