"""The page for programs drives a real robot, and whatever stops the robot ends the program."""

import functools
import json
import signal
import subprocess
import time
from itertools import groupby

import pytest

from harness import START_TIMEOUT
from jetbot.fake.motors import STOPPED
from jetbot_lessons import lessons

from .conftest import OTHER_ROBOT, ROBOT
from .programs import block, chain, drive, let, num, plug, program, set_motion, show, var, wait
from .test_accessibility import LISTEN
from .test_page import DESKTOP, TOUCH_SCREENS
from .test_stop import release

FORWARD = (0.5, 0.5)
ENDLESS = block("controls_whileUntil", {"MODE": "WHILE"}, BOOL=plug("logic_boolean", {"BOOL": "TRUE"}))
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
    world.hold(page, lambda: page.click(f"#{button}"), lambda: page.click("#end"), ROBOT,
               lambda *wheels: close(wheels, speeds))


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


ENDS = {
    "Stop": (lambda page: page.click("#end"), "Stopped."),
    "Escape": (lambda page: page.tap("Escape"), "Stopped."),
    "STOP of all robots": (lambda page: page.click("#stop"), "All robots were stopped."),
    "another tab": (lambda page: (page.new_tab(), page.old_tab()), "The page was hidden"),
    "a change": (lambda page: page.run(CHANGE), "The program was changed."),
    "another robot": (lambda page: page.choose(OTHER_ROBOT), "Another robot was chosen."),
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
            act(page)
        page.wait_for(functools.partial(page.run, "return said.join().includes(arguments[0])", sentence), sentence)


@undisturbed
def test_no_program_drives_a_robot_that_somebody_else_drives(blocks, world, victim):
    page = blocks(program(drive(0.5, 30)))
    world.drive(victim, ROBOT)
    page.click("#run")
    page.wait_for_text("outcome", f"was driving {ROBOT}")


LATE_STATUS = """const receive = socket.onmessage; socket.onmessage = ({data}) => {
    const message = JSON.parse(data);
    for (const robot of Object.values(message.type === 'state' && message.robots))
        Object.assign(robot, {status: 'driving', state: 'driving', cause: ''});
    receive({data: JSON.stringify(message)}); }"""


@undisturbed
def test_an_emergency_stop_from_elsewhere_ends_the_program_whatever_the_robot_still_says(blocks, world):
    page = blocks(program(drive(0.5, 30)))
    page.run(LATE_STATUS)
    run(page, world)
    try:
        with world.stops(ROBOT, what="an emergency stop"):
            world.emergency_stop()
        page.wait_for_text("outcome", "emergency stop")
    finally:
        release(page)
    world.stay_stopped(ROBOT)


@undisturbed
def test_a_page_that_freezes_stops_the_robot_and_its_program_does_not_go_on(blocks, world):
    page = blocks(program(block("controls_repeat_ext", TIMES=num(99), DO=chain(drive(0.5, 0.5), block("robot_stop")))))
    run(page, world)
    try:
        with world.stops(ROBOT, what="SIGSTOP of the browser"):
            page.signal(signal.SIGSTOP)
    finally:
        page.signal(signal.SIGCONT)
    page.wait_for_text("outcome", "This page was interrupted")
    world.stay_stopped(ROBOT, for_seconds=0.6)


@undisturbed
def test_pause_step_and_slow(blocks, world):
    page = blocks(program(drive(0.5, 0.6), let("x", num(3)), drive(-0.5, 30), variables="x"))
    page.click("#step")
    page.wait_for_text("outcome", "Paused")
    assert page.text_of("#python .now") == "drive(0.5, 0, 0.6)"
    world.stay_stopped(ROBOT)
    run(page, world, button="step")
    page.wait_for_text("outcome", "Paused")
    assert page.text_of("#python .now") == "x = 3"
    world.wait_for_stop(ROBOT, "a step")
    page.click("#step")
    page.wait_for_text("variables", "3")
    run(page, world, (-0.5, -0.5), "pause")
    assert page.has("#bar .language:disabled"), "another language would load the page again"
    page.click("#pause")
    world.wait_for_stop(ROBOT, "Pause")
    run(page, world, (-0.5, -0.5), "pause")
    page.click("#end")
    page.wait_for(lambda: page.has("#bar .language:enabled"), "languages to choose from")
    page.set("speed", "0")
    start = time.time()
    run(page, world)
    page.set("speed", "3")
    assert time.time() - start > 0.9, "a slow program waits for a second before each block"


@undisturbed
def test_a_loop_without_a_wait_drives_for_a_second_and_leaves_the_page_alive(blocks, world):
    page = blocks(program(drive(0.5, 0.1), set_motion(0.5, 0), wait(0.1),
                          {**ENDLESS, "inputs": {**ENDLESS["inputs"], "DO": chain(
                              *[block("math_change", {"VAR": {"id": "x"}}, DELTA=num(1))] * 20)}}, variables="x"))
    run(page, world)
    world.wait_for(lambda: world.wheels(ROBOT) == STOPPED, 3.0, "the command to be too old")
    page.wait_for_text("outcome", "A loop runs without a wait")
    assert page.has(".controls_whileUntil.blocklyHighlighted")
    page.click("#end")
    page.wait_for_text("outcome", "Stopped.")


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
def test_waits_too_short_to_send_each_command_drive_on(blocks, world):
    run(blocks(program(block("controls_whileUntil", {"MODE": "WHILE"}, BOOL=plug("logic_boolean", {"BOOL": "TRUE"}),
                             DO=chain(set_motion(0.5, 0), wait(0.01))))), world)
    world.stay(lambda *wheels: wheels != STOPPED, ROBOT, for_seconds=0.6)


def nested(depth):
    value = num(1)
    for _ in range(depth):
        value = plug("math_single", {"OP": "NEG"}, NUM=value)
    return program(show(value))


FORGED = {  # of those that check.js refuses, one each of its ways
    "no program": "hello", "markup as a type": program(block("<img src=x onerror=alert(1)>")),
    "10 MB": " " * 10_000_000 + json.dumps(program()),
    "what Blockly refuses": program({**block("math_number_property"), "extraState": 5}),
}


def test_what_could_not_be_opened_again_is_not_called_kept(blocks):
    page = blocks(program())
    page.run("Blockly.serialization.workspaces.load(JSON.parse(arguments[0]), Blockly.getMainWorkspace())",
             json.dumps(nested(70)))
    page.wait_for_text("kept", "nests more than 60 blocks")


def test_a_forged_program_is_refused_in_a_sentence(blocks):
    page = blocks(program(show(num(5))))
    page.wait_for_text("python", "print(5)")
    for name, content in FORGED.items():
        page.run("document.getElementById('notice').textContent = ''")
        blocks(content)
        page.wait_for(lambda: page.text("notice").endswith("."), f"a sentence for {name}")
        assert page.run("return Blockly.getMainWorkspace().getAllBlocks().length") == 3, "the one before is still there"


@undisturbed
def test_markup_and_ends_of_lines_in_names_stay_names(blocks):
    evil = "</svg><img src=x onerror=window.evil=1>\r\nimport os\nos.x()"
    page = blocks({**program(let("x", num(1)), show(plug("text", {"TEXT": evil})), wait(9)),
                   "variables": [{"name": evil, "id": "x"}]})
    page.wait_for_text("python", "print(")
    page.click("#run")
    page.wait_for_text("prints", "</svg><img")
    assert not page.run("return window.evil || document.querySelector('img')")
    assert not [line for line in page.text("python").splitlines() if line.strip().startswith(("import os", "os."))]


@undisturbed
def test_a_thousand_blocks_load_in_two_seconds(blocks):
    page = blocks(program())
    page.wait_for(lambda: "drive(" not in page.text("python"), "an empty program")
    blocks(program(*[block("controls_repeat_ext", TIMES=num(1), DO=chain(*[drive(0.5, 1)] * 32))] * 10))
    start = time.time()
    page.wait_for(lambda: page.text("python").count("drive(0.5, 0, 1)") == 320, "the Python of all blocks")
    assert time.time() - start < 2.0 + 3.0  # a busy computer
    page.type("title", "Large")
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")


FINGER = 40  # px
NUMBER = ".blocklySvg .math_number .blocklyFieldRect"
NUMBER_BOXES = {"showEditor": "blocklyHtmlInput", "showPromptEditor": "blocklyDialogInput"}  # a computer's, Android's


def test_a_number_may_have_a_decimal_comma(blocks):
    for editor, field in NUMBER_BOXES.items():
        page = blocks(program(drive(0.5, 1)))
        page.wait_for_text("python", "drive(0.5, 0, 1)")
        for typed, x in ("0,7", 0.7), ("-,25", -0.25), ("1,2,3", -0.25):
            page.run(f"Blockly.getMainWorkspace().getBlocksByType('math_number')[0].getField('NUM').{editor}();"
                     f"document.querySelector('.{field}').select()")
            box = page.driver.switch_to.active_element
            assert box.get_attribute("inputmode") == "decimal" and box.size["height"] >= FINGER
            box.send_keys(f"{typed}\n")
            page.wait_for_text("python", f"drive({x}, 0, 1)")


def test_a_number_is_large_enough_for_a_finger_and_its_box_opens_over_it(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.wait_for_text("python", "drive(0.5, 0, 1)")
    size = page.driver.find_element("css selector", NUMBER).rect
    assert size["width"] >= 32 and size["height"] >= 32
    page.run("Blockly.getMainWorkspace().getBlocksByType('math_number')[0].getField('NUM').showEditor()")
    assert page.place_of(".blocklyHtmlInput") == pytest.approx(page.place_of(NUMBER), abs=2)


def test_the_map_shows_the_trail_of_the_run_alone(blocks):
    page = blocks(program())
    page.click("#show-map")
    page.wait_for(page.robot_on_map, "the robot on the map")
    page.run(NOTE_LINES)

    def act():
        blocks(program(drive(0.5, 1.5)))
        page.click("#run")
        page.wait_for_text("outcome", "The program has ended.")
        page.wait_for(lambda: page.run("return longest()") > 8, "its trail")
        blocks(program(wait(0.3)))
        page.click("#run")
        page.wait_for_text("outcome", "The program has ended.")
        page.wait_for(lambda: 0 < page.run("return longest()") < 5, "no trail")
    blocks.undisturbed(act)
    page.click("#show-map")


def test_the_map_shows_the_robot_its_trail_and_the_tasks_world_while_the_program_runs(blocks, world):
    page = blocks(program(drive(0.5, 30)))
    page.receive({"type": "scene", "robot": f"/{ROBOT}", "shapes": [
        {"kind": "course", "width": 0.01, "points": [[0, 0], [1, 0]]},
        {"kind": "goal", "width": 0.2, "points": [[1, 0], [1.2, 0]]}]})
    page.driver.execute_cdp_cmd("Network.enable", {})
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": ["*/map.js"]})
    page.click("#show-map")
    page.wait_for_text("notice", "This could not be loaded. Try again.")
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": []})
    page.click("#show-map")
    page.click("#show-map")
    assert not page.text("python")
    run(page, world)
    page.wait_for(page.robot_on_map, "the robot on the map")
    page.wait_for(lambda: page.shows_on_map("#7c3aed"), "the task's goal")
    page.click("#show-map")
    page.wait_for_text("python", "drive(0.5, 0, 30)")


@undisturbed
def test_the_name_that_is_typed_here_is_announced_after_a_reload_too(blocks, world, pupil):
    page = blocks(program())
    page.type("name", "Ada")
    page.driver.refresh()
    page.wait_for_link()
    page.run("localStorage.removeItem('name')")
    page.choose(ROBOT)
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
    begin = time.time()
    node = world.start(str(folder / "scripts/program.py"), f"__ns:=/{OTHER_ROBOT}")  # no page drives it before
    assert node.wait(START_TIMEOUT) == 0
    world.wait_for_stop(OTHER_ROBOT)
    by_node, begin = world.record.driven(OTHER_ROBOT, begin), time.time()
    page.click("#run")
    page.wait_for_text("outcome", "The program has ended.")
    world.wait_for_stop(OTHER_ROBOT)
    assert world.record.driven(OTHER_ROBOT, begin) == by_node
    assert float(page.text("prints")) == pytest.approx(float(node.log.read_text()), abs=10)


@undisturbed
def test_a_robot_in_si_units_has_them_on_its_blocks_and_in_its_python(blocks):
    page = blocks(program(set_motion(0.3, 0), wait(0.5), block("robot_wheels", LEFT=num(0.5), RIGHT=num(0.5)), wait(9)))
    page.wait_for(lambda: "power" in page.text("blocks"), "the workshop's units")
    page.receive({"type": "robots", "robots": [{
        "id": f"/{ROBOT}", "label": ROBOT, "color": "#808080", "workshop": False, "wheel_separation": 0.1125,
        "max_speed": 0.6, "simulated": True}]})
    page.wait_for(lambda: "m/s" in page.text("blocks"), "SI units")
    assert "(right - left) / 0.1125 * 0.6" in page.text("python")
    start = time.time()
    page.click("#run")
    page.wait_for_text("outcome", "Running")
    page.wait_for(lambda: len([command for command in page.sent() if command.time > start and command.forward]) > 15,
                  "commands")
    assert {command.forward for command in page.sent() if command.time > start and command.forward} == {0.5}


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


TASKS = {"type": "tasks", "tasks": [{"name": "metre", "title": "One metre, and back again", "on": True}]}
PLACES = """return ["There is a newer version of this program. ".repeat(2), "Not kept yet", ""].map((text) => {
    document.getElementById("kept").textContent = text;
    document.getElementById("newer").hidden = !text;
    return JSON.stringify(document.getElementById("blocks").getBoundingClientRect());
});"""


MANY_PRINTS = """const prints = document.getElementById("prints");
    for (let count = 0; count < 30; count += 1) prints.append(document.createElement("li"), `line ${count}`);
    document.getElementById("output").scrollTop = 9999;"""


def test_the_page_fits_tablets_and_phones_and_what_is_said_of_keeping_moves_nothing(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.run(MANY_PRINTS)
    for screen in TABLETS:
        page.resize(*screen)
        page.wait_for(lambda: page.fits("run", "pause", "step", "end", "stop", "release", "robot", "status", "python",
                                        "output"), f"all on {screen}")
        assert page.overlapping() == [], screen
        assert not page.text("small")
        assert len(set(page.run(PLACES))) == 1
        assert not page.outside("#outcome", "#output"), "it scrolls away with what is printed"
    page.receive(TASKS)
    page.resize(1024, 768)
    assert page.run("return document.getElementById('running').clientHeight") < 60, "all in one row"
    page.resize(390, 844)
    page.wait_for(lambda: page.fits("run", "end", "stop", "blocks", "output"), "a phone")
    assert page.overlapping() == []
    assert "tablet" in page.text("small")
    assert not page.outside("#outcome", "#output"), "it scrolls away with what is printed"


JUDGED = """scrollTo(0, 0);
    document.getElementById("outcome").textContent = "The program has ended. A wheel takes 1 at most, not 3.33.";
    document.getElementById("judge").click();"""
SCORE = "One metre: 94.5 points, 12.4 s. Largest loss: it ended 4 cm behind the goal, 2.3 points."


def test_why_a_program_has_ended_and_its_score_are_in_sight_on_each_screen(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.receive(TASKS)
    page.run(MANY_PRINTS)
    for screen in [*TOUCH_SCREENS, DESKTOP]:
        page.resize(*screen)
        page.run(JUDGED)
        page.wait_for_text("score", "No judge has this task now")
        page.run("document.getElementById('score').textContent = arguments[0]", SCORE)
        page.wait_for(lambda: not page.outside("#outcome, #score", "#result") and page.fits("outcome", "score", "stop"),
                      f"outcome and score on {screen}")
        assert page.overlapping() == [], screen


def test_on_a_small_or_magnified_screen_all_of_the_page_is_reached_and_stop_stays(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.receive(TASKS)
    for screen in SMALL:
        page.resize(*screen)
        page.receive({"type": "notice", "text": "Somebody else drives the robot. " * 3})
        for name in "programs", "run", "end", "output", "blocks":
            page.run("document.getElementById(arguments[0]).scrollIntoView({block: 'center'})", name)
            page.wait_for(lambda name=name: page.run(CLEAR, name) and page.fits("stop", "release"),
                          f"{name} on {screen}")
