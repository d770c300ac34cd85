"""The page for programs by keys alone: no mouse, no finger, and the focus is never lost."""

from .conftest import ROBOT
from .messages import TASKS
from .programs import drive, plug, program, show, wait
from .test_program import CHANGE, close, undisturbed
from .test_states import ENDLESS, FAILS

FOCUS = """const { activeElement: focused } = document;
    return focused.closest("#blocks, .blocklyWidgetDiv") ? "blocks" : focused.id"""
SPOKEN = "return document.activeElement.getAttribute('aria-label')"
LISTEN = """window.said = [];
    for (const each of document.querySelectorAll("#outcome, #score, #kept")) new MutationObserver(() => {
        if (each.ariaLive !== "off") said.push(each.textContent);
    }).observe(each, {childList: true});"""
TEXT_BOX = "Blockly.getMainWorkspace().getBlocksByType('text')[0].getField('TEXT').showEditor()"


def wait_for_spoken(page, words):
    page.wait_for(lambda: words in (page.run(SPOKEN) or ""), f"{words!r} to have the focus")


def wait_for_focus(page, wanted, why=""):
    page.wait_for(lambda: focus(page) == wanted, f"the focus on {wanted}: {why}")


def focus(page):
    """Return the id of what has the focus; "blocks": something in Blockly."""
    return page.run(FOCUS)


@undisturbed
def test_keys_alone_attach_a_block_to_the_start_change_its_number_and_run_it(blocks, world):
    page = blocks(program())
    page.tab_to("python")
    page.tap("w", "ArrowDown")
    wait_for_spoken(page, "when the program starts")
    page.tap("t", "ArrowRight", "ArrowDown", "ArrowDown")
    wait_for_spoken(page, "drive straight at x, 0.5, power")
    page.tap("Enter")  # takes it
    page.wait_for(lambda: "Moving drive straight" in page.text_of("body"), "the block below the one that was looked at")
    page.tap("Enter")  # puts it there
    page.wait_for_text("python", "drive(0.5, 0, 1)")
    page.tap("ArrowRight", "ArrowRight")
    wait_for_spoken(page, "Edit x in power: 0.5")
    page.tap("Enter", *"0.4", "Enter")
    page.wait_for_text("python", "drive(0.4, 0, 1)")
    page.tab_to("run")
    world.hold(page, lambda: page.tap("Enter"), lambda: page.tap("Escape"), ROBOT,
               lambda *wheels: close(wheels, (0.4, 0.4)))
    page.wait_for_text("outcome", "The program has ended.")


def test_t_and_w_lead_to_the_blocks_from_anywhere_but_are_letters_in_a_text(blocks):
    page = blocks(program())
    page.type("title", "two")
    assert page.value("title") == "two"
    for name in "run", "output":
        for key, spoken in (("t", None), ("w", "1 stack of blocks")):
            page.tab_to(name)
            page.tap(key)
            page.wait_for(lambda spoken=spoken: focus(page) == "blocks" and page.run(SPOKEN) == spoken,
                          f"{key} at #{name} to lead to the blocks")
    page.tap("Escape", "t", "ArrowRight", "w")
    wait_for_spoken(page, "1 stack of blocks")
    page.tab_to("programs")
    page.tap("Enter")
    page.wait_for(lambda: focus(page) == "work", "the sheet")
    page.tap("t")
    wait_for_focus(page, "work", "a sheet is over the blocks")
    page.tap("Escape")


def test_enter_that_ends_a_conversion_ends_neither_a_name_nor_a_text_of_the_blocks(blocks):
    page = blocks(program(show(plug("text", {"TEXT": ""}))))
    for opens in "document.getElementById('name').focus()", TEXT_BOX:
        page.run(opens)
        field = page.run("return document.activeElement")
        page.compose("たなか")
        page.tap("Enter")
        assert page.run("return document.activeElement") == field, opens


@undisturbed
def test_who_leaves_a_move_gets_where_they_go_and_the_keys_of_the_blocks_still_work(blocks):
    page = blocks(program(wait(1)))
    for leave in lambda: page.tap("Tab"), lambda: page.click("#output"):
        page.tab_to("end")
        page.tap("w", "ArrowDown", "ArrowDown", "m", "ArrowDown")
        leave()
        assert page.run("return document.activeElement.closest('.blocklyTrash, #output')")
        page.tap("w", "ArrowDown")
        wait_for_spoken(page, "when the program starts")


@undisturbed
def test_the_focus_stays_while_a_program_runs_pauses_stops_and_ends(blocks):
    page = blocks(ENDLESS)
    for name, sentence in (("run", "Running"), ("pause", "Paused"), ("step", "Paused"), ("pause", "Running"),
                           ("end", "Stopped."), ("run", "Running")):
        page.tab_to(name)
        page.tap("Enter")
        page.wait_for_text("outcome", sentence)
        wait_for_focus(page, name, sentence)
    page.tap("Escape")
    page.wait_for_text("outcome", "Stopped.")
    wait_for_focus(page, "run")
    page = blocks(FAILS)
    page.tab_to("run")
    page.tap("Enter")
    page.wait_for_text("outcome", "divides by 0")
    wait_for_focus(page, "run", "the block is marked alone")


def test_a_button_that_can_do_nothing_does_nothing(blocks):
    page = blocks(program(drive(0.5, 1)))
    for name in "pause", "end":
        page.tab_to(name)
        page.tap("Enter")
        page.click(f"#{name}")
    assert page.text("outcome") == "Press Run." and page.text("pause") == "Pause"


def test_the_focus_is_not_lost_by_sheets_examples_files_tasks_and_blocks(blocks):
    page = blocks(program(drive(0.5, 1), wait(1)))
    for button, sheet, controls in (("programs", "work", 3), ("overview-button", "overview", 2)):
        page.tab_to(button)
        for close_it in (["Escape"], ["Tab"] * controls + ["Enter"]):
            page.tap("Enter")
            page.wait_for(lambda sheet=sheet: focus(page) == sheet, "the sheet, loaded when opened first")
            page.tap(*close_it)
            wait_for_focus(page, button)
    page.tab_to("examples")
    page.tap("ArrowDown")
    page.wait_for(lambda: page.value("title") == "One metre", "the example")
    wait_for_focus(page, "examples")
    page.tab_to("run")
    page.tap("w", "ArrowDown", "ArrowDown", "Delete")
    page.wait_for(lambda: focus(page) == "blocks" and page.run(SPOKEN), "a block beside the deleted one")
    blocks(program(drive(0.5, 1)))
    wait_for_focus(page, "blocks", "another program is there")
    page.receive(TASKS)
    page.tab_to("judge")
    page.tap("Enter")
    page.wait_for_text("score", "No judge has this task")
    wait_for_focus(page, "judge")
    page.receive({**TASKS, "tasks": []})
    page.wait_for(lambda: focus(page) == "show-curves", "what is in its place to have the focus")


def test_the_focus_goes_into_the_text_and_back_to_where_it_can_be_edited(blocks):
    page = blocks(program(drive(0.5, 1)))
    page.tab_to("edit")
    page.tap("Enter")
    wait_for_focus(page, "edit-question")
    page.tap("Escape")
    wait_for_focus(page, "edit")
    page.tap("Enter", "Tab", "Enter")
    page.wait_for(lambda: page.has("#text .cm-focused"), "the editor")
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
    page.tap("Escape")
    page.tab_to("to-blocks")
    page.tap("Enter")
    wait_for_focus(page, "to-blocks-question")
    page.tap("Tab", "Enter")
    wait_for_focus(page, "edit")


def test_the_focus_is_back_after_the_login_and_goes_on_when_the_other_robot_goes(pupil, world):
    address, code = world.codes()["pupil"].split("#")
    pupil.resize(1024, 768)
    pupil.driver.get(f"{address}program")
    pupil.wait_for_link()
    pupil.tab_to("save")
    pupil.driver.delete_all_cookies()
    pupil.run("socket.close()")
    pupil.wait_for_text("login-error", "Enter the new one")
    wait_for_focus(pupil, "code")
    pupil.tap(*code, "Enter")
    pupil.wait_for(lambda: focus(pupil) == "save", "the focus to be back")
    pupil.wait_for_link()
    pupil.tab_to("robot")
    pupil.receive_class(robots=1)
    pupil.wait_for(lambda: focus(pupil) == "to-pad", "what is next to have the focus")


@undisturbed
def test_a_screen_reader_hears_once_what_has_come_of_a_change_and_of_a_program(blocks):
    page = blocks(FAILS)
    for change in LISTEN, CHANGE.replace("2", "0.5"):
        page.wait_for(lambda: page.text("kept") == "Kept", "the program to be kept")
        page.run(change)
    page.wait_for_text("kept", "Not kept yet")
    page.wait_for(lambda: page.text("kept") == "Kept", "the change to be kept")
    page.click("#run")
    page.wait_for_text("outcome", "divides by 0")
    assert page.run("return said") == ["Kept", "Starting", "Running", "This block divides by 0."]
