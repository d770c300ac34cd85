"""Everybody can use the page for programs: what a screen reader gets of it, and that it stands out."""

from .accessibility import tree
from .conftest import ROBOT
from .messages import robot_named
from .programs import program
from .test_states import TURN, in_blocks

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
    page.receive({"type": "robots", "robots": [robot_named(ROBOT, workshop=False, max_speed=0.6)]})
    page.wait_for(lambda: "Edit z in rad/s: 0.2" in {node.name for node in tree(page)}, "the other units")


def test_a_hint_of_blockly_covers_no_stop_wherever_it_is(blocks):
    page = blocks(TURN)
    page.resize(320, 568)
    in_blocks("m")(page)
    page.wait_for(lambda: page.has(".blocklyToast"), "the hint")
    page.run("document.querySelector('.blocklyToast').style = 'position: fixed; inset: 0'")
    assert page.misplaced("stop", "release") == []
