"""The lesson for the tablet, with a finger: from the pad to blocks, to Python, to the judge."""

from harness import program
from processes import end

from .conftest import ROBOT, TABLET
from .test_work import judge
from .world import moving


def box(page, selector):
    """Return the place and the height of an element as (x, y, height) in px."""
    return page.run("const { x, y, height } = document.querySelector(arguments[0]).getBoundingClientRect();"
                    "return [x, y, height]", selector)


def tap(page, selector):
    """Touch the middle of an element."""
    page.touch_event("touchStart", page.place_of(selector))
    page.touch_event("touchEnd")


def drag(page, kind, above):
    """Open the first part of the toolbox, and drag a block below another one that is in the program."""
    block = f".blocklyFlyout .{kind} > .blocklyPath"
    tap(page, ".blocklyToolboxCategory")
    page.wait_for(lambda: page.has(block), f"{kind} to choose")
    (x, y, _), (left, top, height) = box(page, block), box(page, f".blocklySvg .{above} > .blocklyPath")
    for event, right, down in (("touchStart", x, y), ("touchMove", x + 40, y), ("touchMove", left, top + height)):
        page.touch_event(event, (right + 10, down + 12))
    page.touch_event("touchEnd")
    page.wait_for(lambda: page.has(f".blocklySvg .{kind}"), f"{kind} in the program")


def type_into(page, field, number):
    """Touch a number of the program, and type another one."""
    tap(page, field)
    page.wait_for(lambda: page.has(".blocklyHtmlInput"), "the number to be open")
    page.run("const input = document.activeElement; input.value = arguments[0];"
             "input.dispatchEvent(new Event('input'))", number)
    page.tap("Enter")


def test_the_lesson_for_the_tablet_from_pad_to_blocks_to_python_to_the_judge(page, world):
    page.resize(*TABLET)
    world.drive(page, ROBOT)
    page.lift()
    page.click("#to-program")
    page.wait_for(lambda: page.has(".blocklyToolboxCategory"), "the page for programs")
    page.wait_for_link()
    page.choose(ROBOT)
    page.click("#programs")
    page.click("#new")  # the robot may have programs of other tests
    drag(page, "robot_drive", "robot_start")
    drag(page, "robot_stop", "robot_drive")
    type_into(page, ".blocklySvg .robot_drive .math_number ~ .math_number .blocklyEditableField", "3.33")
    page.wait_for_text("python", "    drive(0.5, 0, 3.33)\n    stop()")
    world.press_until(lambda: page.text_of("#python .now") == "drive(0.5, 0, 3.33)" and moving(*world.wheels(ROBOT)),
                      page, page.start_program, lambda: page.click("#end"))
    page.click("#end")
    world.wait_for_stop(ROBOT)
    page.type("title", "my metre")
    page.wait_for(lambda: page.text("kept") == "Kept", "the program to be kept")
    process = world.start(program("driving_tasks", "class_judge.py"))
    page.wait_for(lambda: page.element("judge").is_displayed(), "the tasks")
    judge(page, world, "points")
    assert page.text("score").startswith("One metre: ")
    end([process])
