"""Everybody can use both pages: by keys alone, with a screen reader, by day and by night."""

from .accessibility import tree, violations
from .conftest import ROBOT
from .messages import robot_named
from .programs import program
from .screens import DESKTOP
from .test_access import split
from .test_page import FOCUSED, focus_on, wait_for_focus
from .test_states import TURN, in_blocks
from .test_stop import release

COUNT_MOVING = """return [...document.querySelectorAll('*')].filter(each => {
    const style = getComputedStyle(each);
    return style.animationName !== 'none' || style.transitionDuration.split(', ').some(time => time !== '0s');
}).length"""
EDGES = """const { borderTopWidth, outlineWidth } = getComputedStyle(document.querySelector(arguments[0]));
return [borderTopWidth, outlineWidth]"""

ALL_BLOCKS = """
const workspace = Blockly.getMainWorkspace(), toolbox = workspace.getToolbox();
const categories = toolbox.getToolboxItems();
workspace.getVariableMap().createVariable("n");
for (const category of [...categories, ...categories]) { // a function can be called once it is there
  toolbox.setSelectedItem(category);
  for (const each of workspace.getFlyout().getWorkspace().getTopBlocks()) {
    Blockly.serialization.blocks.append(Blockly.serialization.blocks.save(each), workspace);
  }
}
toolbox.clearSelection();
"""
ENABLE = """for (const each of Blockly.getMainWorkspace().getAllBlocks())
    each.setDisabledReason(false, "ORPHANED_BLOCK")"""


def test_who_prefers_no_motion_or_high_contrast_gets_it_and_in_english_too_names_have_what_a_button_shows(page, world):
    for path, chosen in ("program", "show-map"), ("", "show-codes"):
        page.open(f"{world.address}{path}")
        page.resize(*DESKTOP, touch=False)
        assert violations(page) == [], path
        page.media(forced_colors="active")
        page.click(f"#{chosen}")
        assert page.run(EDGES, f"#{chosen}")[0] == "3px"
        page.tab_to("stop")
        assert page.run(EDGES, "#stop") == ["4px", "3px"]
        page.media(prefers_reduced_motion="reduce")
    assert page.run(COUNT_MOVING) == 0


def holds_arrow(page, world):
    world.hold(page, lambda: page.press("ArrowUp"), lambda: page.let_go("ArrowUp"), ROBOT)
    page.wait_for_text("pad-news", "You steer ahead.")
    page.let_go("ArrowUp")
    page.wait_for(lambda: not page.text("pad-news"), "the end of that")


def test_keys_alone_lead_from_the_login_to_driving_taking_over_stop_and_release(page, pupil, world):
    address, code = split(world.codes()["pupil"])
    pupil.driver.delete_all_cookies()
    pupil.driver.get(address)
    wait_for_focus(pupil, "code")
    for key in [*code, "Enter"]:
        pupil.tap(key)
    wait_for_focus(pupil, "pad")
    pupil.wait_for_text("driver", "Free to drive")
    holds_arrow(pupil, world)
    page.tab_to("take")
    page.tap("Enter")
    wait_for_focus(page, "pad")
    holds_arrow(page, world)
    for button, status in ("stop", "emergency stop"), ("release", "was released"):
        page.tab_to(button)
        page.tap("Enter")
        page.wait_for_text("status", status)
        assert page.run(FOCUSED) == button


def test_a_screen_reader_finds_the_pad_and_learns_where_the_robot_is_and_the_focus_goes_down_the_page(page):
    page.send({"type": "reset", "robot": None})  # a test before has driven
    page.wait_for(lambda: "faces ahead" in page.element("map").get_attribute("aria-label"), "the robot's place")
    place = page.element("map").get_attribute("aria-label")
    found = tree(page)
    pad = next(each for each in found if each.role == "application")
    assert pad.name.startswith("Joystick") and "arrow keys" in pad.description and place in pad.description
    assert any(each.role == "image" and each.name == place for each in found)
    assert any((each.role, each.name, each.value) == ("slider", "Speed", "50") for each in found)
    order = [each.name for each in found if each.role in ("region", "button")]
    assert order.index("Robot and people") < order.index("Map") < order.index("Drive") < order.index("STOP all robots")
    controls = "robot", "zoom-in", "speed", "stop", "release"
    assert page.run("return [...document.querySelectorAll(arguments[0])].map(({ id }) => id)",
                    ",".join(f"#{name}" for name in controls)) == list(controls)
    for screen in (390, 844), (820, 1180), DESKTOP:
        page.resize(*screen)
        heights = [round(page.place_of(f"#{name}")[1]) for name in controls]
        assert heights == sorted(heights), screen


def test_arrow_keys_look_through_the_languages_and_enter_chooses_one_if_the_page_can_load_again(page):
    focus_on(page, "#bar .language")
    page.run("window.load = window.fetch; window.fetch = () => Promise.reject(new TypeError('no connection'))")
    page.tap("ArrowDown")
    page.tap("Enter")
    page.wait_for(lambda: page.run("return document.activeElement.value") == "en", "English again")
    page.run("window.fetch = window.load")
    page.tap("ArrowDown")
    page.tap("Escape")
    assert page.run("return document.activeElement.value") == "en"
    page.tap("ArrowDown")
    assert page.run("return document.activeElement.value === 'de' && 'load' in window")
    page.tap("Enter")
    try:
        page.wait_for(lambda: page.run("return document.documentElement.lang") == "de", "German")
        assert page.run("return document.activeElement.value") == "de"
        page.wait_for_link()
        release(page)  # Escape stops the robots, too
    finally:
        page.run("localStorage.removeItem('language')")


def test_texts_and_the_focus_stand_out_on_all_blocks_by_day_and_night(blocks):
    page = blocks(program())
    page.run(ALL_BLOCKS)
    page.run(ENABLE)
    page.tap("w")
    for mode in "light", "dark":
        page.media(prefers_color_scheme=mode)
        assert page.faint_blocks() == [], mode


def test_a_screen_reader_reads_blocks_their_fields_units_and_what_they_do_and_no_hint_of_them_covers_stop(blocks):
    page = blocks(TURN)
    nodes = [(node.role, node.name) for node in tree(page)]
    for role, name in (("tree", "Kinds of blocks"), ("treeitem", "Drive"), ("figure", "1 stack of blocks"),
                       ("figure", "Begin stack, when the program starts,"),
                       ("figure", "turn, left, at z, 0.2, power for, 1, s, has inputs,"),
                       ("button", "side: left"), ("button", "Edit z in power: 0.2"), ("button", "Edit seconds: 1")):
        assert (role, name) in nodes, f"{name} is not among {nodes}"
    assert "Turns on the spot for so many seconds." in {node.description for node in tree(page)}
    page.receive({"type": "robots", "robots": [robot_named(ROBOT, workshop=False, max_speed=0.6)]})
    page.wait_for(lambda: "Edit z in rad/s: 0.2" in {node.name for node in tree(page)}, "the other units")
    page.resize(320, 568)
    in_blocks("m")(page)
    page.wait_for(lambda: page.has(".blocklyToast"), "Blockly's hint")
    page.run("document.querySelector('.blocklyToast').style = 'position: fixed; inset: 0'")
    assert page.misplaced("stop", "release") == [], "the hint covers them"
