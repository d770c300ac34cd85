"""Everybody can use the page for programs: what a screen reader gets of it, and what axe-core's rules ask for."""

from .accessibility import tree, violations
from .conftest import OTHER_ROBOT, ROBOT
from .programs import as_file, block, drive, num, program
from .test_keys import ENDLESS, FAILS, TASKS, press
from .test_python_page import suggested, type_at_end
from .test_work import ALL_BLOCKS, edit

TURN = program(drive(0.5, 1), block("robot_turn", {"SIDE": "LEFT"}, Z=num(0.2), SECONDS=num(1)))
SCORES = {"type": "scores", "scores": [{"task": "One metre", "robot": ROBOT, "score": 87.3, "seconds": 3.4,
                                        "name": "Ada"}]}


def runs(content, outcome):
    """Return what runs a program, and waits for what is said of it."""
    def run(page, load):
        load(content)
        page.click("#run")
        page.wait_for_text("outcome", outcome)
    return run


def in_blocks(*keys):
    """Return what presses keys in the blocks, from the block that turns on."""
    def act(page, _):
        page.tap("Escape")
        page.tab_to("run")
        press(page, "w", "ArrowDown", "ArrowDown", "ArrowDown", *keys)
    return act


def menu(page, load):
    in_blocks()(page, load)
    page.press("Control")
    page.tap("Enter")
    page.let_go("Control")
    page.wait_for(lambda: page.has(".blocklyContextMenu"), "the menu")


def judged(page, _):
    page.receive(TASKS)
    page.click("#judge")
    page.wait_for_text("score", "No judge has this task")


def opens(name, sheet):
    def act(page, _):
        page.receive(SCORES)
        page.click(f"#{name}")
        page.wait_for(page.element(sheet).is_displayed, sheet)
    return act


def asks(page, _):
    page.run("dispatchEvent(new Event('ask')); document.getElementById('login').showModal();"
             "document.getElementById('login-error').textContent = 'This code is wrong.'")


def shows_map(page):
    if not page.has("#show-map[aria-pressed=true]"):  # Judge me shows it, too
        page.click("#show-map")


def suggests(page, _):
    type_at_end(page, "\nrospy.")
    page.wait_for(lambda: suggested(page), "suggestions")


ENABLE = """for (const each of Blockly.getMainWorkspace().getAllBlocks())
    each.setDisabledReason(false, "ORPHANED_BLOCK")"""
STATES = {  # what leads to it from the one before
    "no blocks": lambda page, load: load(program()),
    "an example": lambda page, _: page.set("examples", "Follow the line"),
    "kinds of blocks": lambda page, _: (page.tab_to("run"), press(page, "t", "ArrowDown", "ArrowRight")),
    "blocks": lambda page, load: load(TURN),
    "a choice": in_blocks("ArrowRight", "Enter"),
    "a number": in_blocks("ArrowRight", "ArrowRight", "ArrowRight", "Enter"),
    "a menu": menu,
    "a move": in_blocks("m"),
    "ended by an error": runs(FAILS, "divides by 0"),
    "running": runs(ENDLESS, "Running"),
    "stopped": lambda page, _: press(page, "Escape"),
    "judged": judged,
    "Programs": opens("programs", "work"),
    "Class": opens("overview-button", "overview"),
    "map": lambda page, _: (press(page, "Escape"), shows_map(page), page.tap("Escape")),
    "question": lambda page, _: (page.click("#show-map"), page.click("#edit")),
    "text": lambda page, _: edit(page),
    "suggestions": suggests,
    "text that failed": runs({**program(), "python": "def f(x)\n    return 'ä' + 1 / x  # 0\n"}, "colon"),
    "login": asks,
}


def broken_rules(page, load, *absent):
    """Return the rules that are broken in each state but the absent ones."""
    broken = {}
    for name, act in STATES.items():
        if name in absent:
            continue
        act(page, load)
        broken[name] = violations(page)
    return {name: rules for name, rules in broken.items() if rules}


def test_the_page_for_programs_breaks_no_rule_on_a_teachers_desktop_by_day(blocks):
    page = blocks(program())
    page.resize(1280, 800, touch=False)
    assert broken_rules(page, blocks) == {}


def test_the_page_for_programs_breaks_no_rule_on_a_pupils_tablet_by_night(pupil, world, tmp_path):
    pupil.resize(768, 1024)
    pupil.driver.get(world.codes()["pupil"].replace("#", "program#"))
    pupil.wait_for_link()
    pupil.choose(OTHER_ROBOT)  # a cockpit keeps a number of programs per robot
    pupil.media(prefers_color_scheme="dark")
    try:
        assert broken_rules(pupil, lambda content: load(pupil, as_file(tmp_path, content)), "Class") == {}
    finally:
        pupil.media()


def load(page, file):
    page.element("file").send_keys(file)
    page.wait_for(lambda: not page.value("file"), "the file to be read")


def test_texts_and_the_focus_stand_out_on_all_blocks_by_day_and_night(blocks):
    page = blocks(program())
    page.run(ALL_BLOCKS)
    page.run(ENABLE)
    page.tap("w")
    for mode in "light", "dark":
        page.media(prefers_color_scheme=mode)
        assert page.faint_blocks() == [], mode
    page.media()


def test_a_screen_reader_reads_blocks_their_fields_units_and_what_they_do(blocks):
    page = blocks(TURN)
    nodes = [(node.role, node.name) for node in tree(page)]
    for role, name in (("tree", "Kinds of blocks"), ("treeitem", "Drive"), ("figure", "1 stack of blocks"),
                       ("figure", "Begin stack, when the program starts,"),
                       ("figure", "turn, left, at z, 0.2, power for, 1, s, has inputs,"),
                       ("button", "side: left"), ("button", "Edit z in power: 0.2"), ("button", "Edit seconds: 1")):
        assert (role, name) in nodes, f"{name} is not among {nodes}"
    assert "Turns on the spot for so many seconds." in {node.description for node in tree(page)}
    page.receive({"type": "robots", "robots": [{
        "id": f"/{ROBOT}", "label": ROBOT, "color": "#808080", "workshop": False,
        "wheel_separation": 0.1125, "max_speed": 0.6, "simulated": True}]})
    page.wait_for(lambda: "Edit z in rad/s: 0.2" in {node.name for node in tree(page)}, "the other units")


def test_a_hint_of_blockly_covers_no_stop_wherever_it_is(blocks):
    page = blocks(TURN)
    page.resize(320, 568)
    in_blocks("m")(page, blocks)
    page.wait_for(lambda: page.has(".blocklyToast"), "the hint")
    page.run("document.querySelector('.blocklyToast').style = 'position: fixed; inset: 0'")
    assert page.misplaced("stop", "release") == []
