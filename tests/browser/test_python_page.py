"""A program that is a text: from blocks to Python and back, edited, run, kept, and opened again."""

from contextlib import contextmanager
from functools import partial

from .conftest import ROBOT, TABLET
from .engine import KEYS
from .programs import drive, program
from .screens import DESKTOP
from .test_program import FORWARD, SMALL, TABLETS, close, undisturbed
from .test_work import edit, rename

NODE = """import rospy
from geometry_msgs.msg import Twist

rospy.init_node("mine")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
motion = Twist()
motion.linear.x = 0.5
count = 0
"""
ENDLESS = NODE + """while not rospy.is_shutdown():
    print("off we go")
    count = count + 1
    publisher.publish(motion)
    rate.sleep()
"""
LOOP = ENDLESS.split("\n")[9:]
FAILS = NODE + "\n" * 80 + "print(1 / count)\n"


def text(blocks, python):
    """Open a program that is this text; return the page."""
    page = blocks({**program(drive(0.5, 1)), "python": python})
    page.wait_for(lambda: python.startswith(shown(page)[:200]) and shown(page), "the text")
    return page


def shown(page):
    """Return the text in the editor, of which the lines in sight exist."""
    return page.run("return [...document.querySelectorAll('#text .cm-line')].map(line => line.innerText"
                    ".replace(/\\n$/, '')).join('\\n').trimEnd()")


def actions(page):
    from selenium.webdriver.common.action_chains import ActionChains  # which may be missing where the file is only read
    return ActionChains(page.driver)


def type_keys(page, *keys, held=""):
    """Type keys while another one is held."""
    chain = actions(page)
    if held:
        chain.key_down(held).send_keys(*keys).key_up(held).perform()
    else:
        chain.send_keys(*keys).perform()


def type_first(page, line):
    """Type a line above the text."""
    page.click("#text .cm-content")
    type_keys(page, KEYS["Home"], held=KEYS["Control"])
    type_keys(page, line, KEYS["Enter"])


def type_at_end(page, *keys):
    """Type keys at the end of the text."""
    page.click("#text .cm-content")
    type_keys(page, KEYS["End"], held=KEYS["Control"])
    type_keys(page, *keys)


def marked(page, kind):
    """Return the line that is marked as "now" or "failed"."""
    return page.run("return document.querySelector(`#text .${arguments[0]}`)?.innerText", kind)


def drives(page, world, speeds=FORWARD):
    """Run the text until the wheels turn at these speeds."""
    world.run(page, ROBOT, lambda *wheels: close(wheels, speeds))


def is_marked(page, kind, line):
    return marked(page, kind) == line


def suggested(page):
    return page.run("return [...document.querySelectorAll('#text .cm-completionLabel')].map(each => each.innerText)")


def variables(page):
    """Return the variables that the page shows: {name: value}."""
    return dict(page.run("return [...document.querySelectorAll('#variables dt')]"
                         ".map(name => [name.innerText, name.nextSibling.innerText])"))


def reload(page):
    page.driver.refresh()
    page.wait_for_link()


def test_the_python_of_blocks_is_edited_kept_opened_again_and_seen_by_others(blocks, pupil, world):
    page = blocks(program(drive(0.5, 1)))
    rename(page, "Text")
    page.click("#edit")
    page.wait_for_text("edit-question", "From now on this program is text. The blocks stay as a copy.")
    page.tap("Escape")
    assert page.text("blocks") and not page.has("#text:not([hidden])"), "nothing has changed"
    edit(page)
    assert page.run("return getSelection().anchorNode.parentElement.closest('.cm-line').innerText") == "def main():"
    assert not page.text("blocks"), "the editor has their place"
    type_first(page, "# mine")
    assert shown(page).startswith("# mine\n")
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
    reload(page)
    page.wait_for(lambda: shown(page).startswith("# mine\n"), "the text, after a reload")
    pupil.driver.get(world.codes()["pupil"].replace("#", "program#"))
    pupil.wait_for_link()
    pupil.choose(ROBOT)
    pupil.wait_for(lambda: shown(pupil).startswith("# mine\n"), "the text on another page")
    page.click("#overview-button")
    page.wait_for_text("all-programs", f"{ROBOT}: Text")
    assert "# mine" in page.download("download-all", "programs.txt").read_text().split("_Text.py", 1)[1]
    page.run("[...document.querySelectorAll('#all-programs .name')]"
             f".find(each => each.textContent === '{ROBOT}: Text').click()")
    page.wait_for_text("kept", "You can look at this program")
    assert "# mine" in shown(page)
    assert page.run("return document.querySelector('.cm-content').contentEditable") == "false"


def test_back_to_blocks_gives_them_as_they_were_and_keeps_the_text_as_an_earlier_version(blocks):
    page = blocks(program(drive(0.5, 1)))
    rename(page, "There and back")
    edit(page)
    type_first(page, "# mine")
    page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
    page.click("#to-blocks")
    page.wait_for_text("to-blocks-question", "The text stays as an earlier version in Programs.")
    page.click("#to-blocks-question-yes")
    page.wait_for_text("python", "drive(0.5, 0, 1)")
    assert not page.has("#text:not([hidden])") and "Sense" in page.text("blocks")
    page.wait_for(lambda: page.text("kept") == "Kept", "the blocks to be kept")
    reload(page)
    page.wait_for_text("python", "drive(0.5, 0, 1)")
    page.click("#programs")
    earlier = "[...document.querySelectorAll('#work-list .earlier .name')]" \
              ".find(each => each.textContent.startsWith('There and back, version'))"
    page.wait_for(lambda: page.run(f"return Boolean({earlier})"), "the earlier version")
    page.run(f"{earlier}.click()")
    page.wait_for(lambda: shown(page).startswith("# mine\n"), "the text")


@undisturbed
def test_a_text_drives_its_line_is_marked_its_variables_are_in_sight_and_a_change_ends_it(blocks, world):
    page = text(blocks, ENDLESS)
    drives(page, world)
    page.wait_for(lambda: marked(page, "now") in LOOP, "the line that runs")
    page.wait_for(lambda: page.text("prints").count("off we go") > 20, "many prints")
    with world.stops(ROBOT, what="Pause"):
        page.click("#pause")
    page.wait_for(lambda: int(variables(page).get("count", 0)) > 5, "its variables")
    page.wait_for(lambda: not page.outside("#variables", "#output"), "the variables, above many prints")
    page.click("#pause")
    page.wait_for(lambda: close(world.wheels(ROBOT), FORWARD), "it to go on")
    with world.stops(ROBOT, what="a change"):
        type_at_end(page, "#")
    page.wait_for_text("outcome", "The program was changed. Run it again.")
    assert not marked(page, "now")


def test_the_line_that_runs_or_fails_is_in_sight_and_after_the_end_what_was_in_sight_before(blocks, world):
    page = text(blocks, NODE + "\n" * 60 + "for count in range(20):\n    publisher.publish(motion)\n    rate.sleep()\n")
    down = partial(page.run, "return document.querySelector('#text .cm-scroller').scrollTop")
    page.run("document.querySelector('#text .cm-scroller').scrollTop = 300")

    def act():
        page.click("#run")
        page.wait_for(lambda: down() > 600, "the line that runs")
        page.wait_for_text("outcome", "The program has ended.")
    blocks.undisturbed(act)
    page.wait_for(lambda: down() == 300, "the part that was in sight")
    blocks({**program(), "python": FAILS})
    page.click("#run")
    page.wait_for_text("outcome", "This line divides by 0")
    page.wait_for(lambda: marked(page, "failed") == "print(1 / count)", "the line to be marked")
    assert not page.outside("#text .failed", "#text")
    world.wait_for_stop(ROBOT)
    type_at_end(page, "#")
    page.wait_for_text("outcome", "Press Run.")
    assert not marked(page, "failed")


def test_a_text_from_a_file_is_opened_and_saved_as_it_is_and_what_could_hide_goes(blocks, tmp_path):
    page = blocks(program())
    file = tmp_path / "Mine.v2.py"
    file.write_bytes("print(1)\r\n\tx = '\u202ea\u0000ä👩‍🏫'  # \u00a0\n\n".encode())
    page.element("file").send_keys(str(file))
    page.wait_for(lambda: page.text("kept") == "Kept" and page.value("title").startswith("Mine.v2"), "it to be kept")
    assert shown(page) == "print(1)\n\tx = 'aä👩‍🏫'  # •", "what Python takes for no space is seen"
    page.set("title", "As it is")
    saved = page.download("save", "my_as_it_is.py.txt")
    assert saved.read_text() == "print(1)\n\tx = 'aä👩‍🏫'  # \u00a0\n\n"
    assert "\n|print(1)\n" in page.download("package", "my_as_it_is.txt").read_text()
    page.element("file").send_keys(str(saved))
    page.wait_for(lambda: page.value("title") == "my_as_it_is", "it to be opened again")
    assert shown(page) == "print(1)\n\tx = 'aä👩‍🏫'  # •"


def test_tab_indents_and_escape_then_tab_leaves_the_text_in_both_directions(blocks):
    page = text(blocks, "if True:\nprint(1)\n")
    page.click("#text .cm-line:nth-child(2)")
    page.tap("Tab")
    assert shown(page) == "if True:\n    print(1)"
    type_keys(page, KEYS["Tab"], held=KEYS["Shift"])
    assert shown(page) == "if True:\nprint(1)"
    for back in [KEYS["Tab"]], [KEYS["Shift"], KEYS["Tab"]]:
        actions(page).send_keys(KEYS["Escape"]).key_down(back[0]).send_keys(*back[1:]).key_up(back[0]).perform()
        page.wait_for(lambda: not page.has("#text .cm-focused"), "the focus elsewhere")
        page.click("#text .cm-content")
    page.click("#text [aria-label=Indent]")
    page.click("#text [aria-label=Undo]")
    assert page.has("#text .cm-focused"), "the keyboard of a tablet stays"


def test_names_of_the_program_and_its_modules_are_suggested_and_enter_is_still_a_new_line(blocks):
    page = text(blocks, "import rospy\nseconds = 1\n")
    type_at_end(page, "sec")
    page.wait_for(lambda: "seconds" in suggested(page), "the program's name")
    type_keys(page, KEYS["Enter"], "rospy.sl")
    page.wait_for(lambda: "sleep" in suggested(page), "what the module has")
    type_keys(page, KEYS["ArrowDown"], KEYS["Enter"])
    page.wait_for(lambda: shown(page) == "import rospy\nseconds = 1\nsec\nrospy.sleep", "what was chosen")


@contextmanager
def blocked(page, pattern):
    """Let the browser load no such file."""
    devtools = page.driver.execute_cdp_cmd
    devtools("Network.enable", {})
    devtools("Network.setCacheDisabled", {"cacheDisabled": True})
    devtools("Network.setBlockedURLs", {"urls": [pattern]})
    try:
        yield
    finally:
        devtools("Network.setBlockedURLs", {"urls": []})
        devtools("Network.disable", {})
        page.errors()  # what was blocked


def test_a_text_is_shown_and_kept_where_its_editor_cannot_be_loaded(blocks):
    page = blocks(program(drive(0.5, 1)))
    with blocked(page, "*/codemirror.js"):
        reload(page)
        blocks({**program(drive(0.5, 1)), "python": ENDLESS})
        page.wait_for_text("notice", "This could not be loaded. Try again.")
        assert page.text("text") == ENDLESS.strip()
        page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
        page.click("#run")
        page.wait_for_text("outcome", "This could not be loaded.")
    reload(page)
    page.wait_for(lambda: shown(page) == ENDLESS.strip(), "the text in its editor")


def test_the_text_is_large_and_all_of_the_page_fits_tablets_and_phones(blocks):
    page = text(blocks, ENDLESS)
    for screen in [*TABLETS, DESKTOP]:
        page.resize(*screen)
        if screen == TABLET:
            assert page.run("return document.getElementById('bar').clientHeight") < 60, "one row"
        page.wait_for(lambda: page.fits("run", "pause", "step", "end", "stop", "release", "text", "view", "output"),
                      f"all on {screen}")
        assert page.overlapping() == [], screen
        assert page.small_controls(44) == [], screen
        assert float(page.run("return getComputedStyle(document.querySelector('.cm-line')).fontSize")[:-2]) >= 15
        assert page.run("const {width, height} = document.getElementById('text').getBoundingClientRect();"
                        "return width * height / innerWidth / innerHeight") > 0.35, screen
    for screen in [(390, 844), *SMALL]:
        page.resize(*screen)
        page.wait_for(lambda: page.fits("stop"), f"STOP on {screen}")
        assert page.overlapping() == [], screen
        assert shown(page) == ENDLESS.strip()
