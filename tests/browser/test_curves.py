"""The curves show what the robot reported, as a rosbag of the same drive has it: beside the blocks and on the pad."""

import csv
import math
import signal
import time
from contextlib import contextmanager

import rosbag

from harness import START_TIMEOUT

from .accessibility import violations
from .conftest import OTHER_ROBOT, ROBOT, TABLET
from .programs import block, chain, drive, num, plug, program, set_motion, wait
from .screens import DESKTOP, FINGER, TOUCH_SCREENS

ODOM = "x (m)", "y (m)", "yaw (rad)", "speed (m/s)", "turn rate (rad/s)"
WHEELS = "command x", "command z", "left wheel (power)", "right wheel (power)"
EYES = "left eye", "middle eye", "right eye"
TOPICS = {f"/{ROBOT}/{topic}": columns for topic, columns in {
    "odom": ODOM, "jetbot_controller/wheels": WHEELS, "line": EYES, "battery": ("battery (V)",)}.items()}
LATE = 0.1          # s between the bag's time of a message without a stamp, and the cockpit's
STILL = 0.5         # s: the simulated robot reports where it is 50 times a second
MOST = 0.9          # of the messages: on a busy computer ROS drops some, here or in the bag
TEXT = {"TEXT": "heading"}
PLOT = block("robot_plot", NAME=plug("text", TEXT), VALUE=plug("robot_here", {"WHAT": "HEADING"}))
TURNS = program(drive(0.5, 1), set_motion(0.3, 0.3), block("controls_repeat_ext", TIMES=num(10), DO=chain(
    wait(0.1), PLOT)), drive(-0.4, 0.5))
COLOURS = """const { width, height } = arguments[0] && document.querySelector("#curves canvas");
    const { data } = document.querySelector("#curves canvas").getContext("2d").getImageData(0, 0, width, height);
    const style = getComputedStyle(document.getElementById("curves"));
    const wanted = arguments[0].map(each => style.getPropertyValue(each).trim().match(/\\w\\w/g).map(
        part => parseInt(part, 16)));
    return wanted.map(([red, green, blue]) => { let count = 0;
        for (let at = 0; at < data.length; at += 4)
            count += data[at] === red && data[at + 1] === green && data[at + 2] === blue;
        return count; });"""


@contextmanager
def recorded(world, file):
    """Record what the robot publishes into this file."""
    bag = world.start("rosbag", "record", "--output-name", str(file), *TOPICS)
    world.wait_for(lambda: all(any(name.startswith("/record_") for name in world._nodes(1, topic)) for topic in TOPICS),
                   START_TIMEOUT, "the recorder")
    yield
    bag.send_signal(signal.SIGINT)
    assert bag.wait(START_TIMEOUT) == 0, bag.log.read_text()
    world.wait_for(file.exists, START_TIMEOUT, "what is recorded: its node ends after rosbag itself")


def read_bag(file):
    """Return what a bag has: {topic: [(stamp, values)]}; the stamp of a message that has none is when it came."""
    found = {topic: [] for topic in TOPICS}
    with rosbag.Bag(str(file)) as bag:
        for topic, message, came_at in bag.read_messages():
            stamp = (message.header.stamp if hasattr(message, "header") else came_at).to_sec()
            found[topic].append((stamp, values_of(message)))
    return found


def values_of(message):
    if hasattr(message, "twist"):
        pose, twist = message.pose.pose, message.twist.twist
        yaw = 2 * math.atan2(pose.orientation.z, pose.orientation.w)
        return pose.position.x, pose.position.y, yaw, twist.linear.x, twist.angular.z
    return tuple(message.data) if hasattr(message, "data") else (message.voltage,)


def read_table(file):
    """Return the rows of a table."""
    with open(file, newline="") as lines:
        return list(csv.DictReader(lines))


def column(rows, *names):
    """Return (stamp, values) of the rows that have these."""
    return [(float(row["stamp (s)"]), tuple(float(row[name]) for name in names)) for row in rows if row[names[0]]]


def show_curves(page, *strips):
    """Show the curves, with these strips beside those that are shown at first."""
    page.run("localStorage.setItem('curves', arguments[0])", " ".join(["wheels speed printed", *strips]))
    page.click("#show-curves")
    page.wait_for(lambda: page.has("#curves canvas") and float(length(page) or 0), "the robot's first values")


def values(page):
    """Return what a screen reader says of the values."""
    return page.run("return document.getElementById('curves-moment').ariaValueText ?? ''")


def drives(page):
    """Return the names of the drives."""
    return page.run("return [...document.querySelectorAll('#curves span > *')].map(each => each.textContent)")


def picture(page):
    return page.run("return document.querySelector('#curves canvas').toDataURL()")


def run(page, world):
    """Run the program, again if it is disturbed; wait until the drive has ended, and return its name."""
    def act():
        page.click("#run")
        page.wait_for_text("outcome", "The program has ended.")
    world.undisturbed(page, act)
    wait_for_end(page)
    return drives(page)[0]


def wait_for_end(page):
    """Wait until the newest drive has not become longer for a while."""
    seen = []

    def is_over():
        seen.append((time.monotonic(), length(page)))
        return seen[-1][1] != "0" and any(then == seen[-1][1] and seen[-1][0] - at > STILL for at, then in seen)
    page.wait_for(is_over, "the end of the drive")


def test_the_table_has_what_a_rosbag_of_the_same_drive_has(blocks, world, tmp_path):
    page = blocks(TURNS)
    show_curves(page, "eyes")
    page.wait_for(lambda: "left 1.00" in values(page), "the eyes, which somebody has to ask for")
    with recorded(world, tmp_path / "drive.bag"):
        newest = run(page, world)
        rows = [row for row in read_table(page.download("curves-save", f"curves_{ROBOT}.csv"))
                if f"Drive {row['drive']}" == newest]
    bag = read_bag(tmp_path / "drive.bag")
    for topic, names in TOPICS.items():
        drawn = column(rows, *names)
        assert drawn, f"nothing of {topic} in {len(rows)} rows of {newest}"
        (first, _), (last, _) = drawn[0], drawn[-1]
        if names in (ODOM, ("battery (V)",)):
            known = dict(bag[topic])
            common = [(stamp, found) for stamp, found in drawn if stamp in known]
            assert common == [(stamp, known[stamp]) for stamp, _ in common], topic
            published = sum(first <= stamp <= last for stamp in known)
        else:
            common = [(stamp, found) for stamp, found in drawn if any(
                abs(at - stamp) < LATE and found == published for at, published in bag[topic])]
            assert len(common) >= MOST * len(drawn), f"{topic} has other values"
            published = sum(first - LATE < at < last + LATE for at, _ in bag[topic])
        assert len(common) >= MOST * published - 2, f"{topic}: {len(common)} of {published}"
    assert len(column(rows, *ODOM)) > 60 and len(column(rows, *WHEELS)) > 3 and len(column(rows, *EYES)) > 30
    check_prints(page, rows)


def check_prints(page, rows):
    """Check that what is printed is a curve, too, at the times at which the robot was there."""
    printed, headings = column(rows, "heading"), column(rows, "yaw (rad)")
    lines = page.text("prints").splitlines()
    assert [f"heading {value:.6g}" for _, (value,) in printed] == lines and len(lines) == 10
    first = headings[0][1][0]
    for stamp, (value,) in printed:
        near = [math.degrees(math.remainder(yaw - first, math.tau)) for at, (yaw,) in headings
                if abs(at - stamp) < 0.3]
        assert min(near) - 2 < value < max(near) + 2, f"{value} at {stamp}: {near}"


def test_two_drives_are_above_each_other_and_pause_holds_the_picture(blocks, world):
    page = blocks(program(drive(0.5, 0.6)))
    show_curves(page)
    run(page, world)
    world.run(page, ROBOT)
    page.wait_for(lambda: "Speed: 0.0" not in values(page), "its speed")
    page.click("#curves-pause")
    page.wait_for_text("curves-pause", "Go on")
    first, held = drives(page)[0], picture(page)
    page.wait_for(lambda: page.text("outcome") != "Running", "the program's end")
    assert picture(page) == held
    assert run(page, world) == first and "Go on" in page.text("curves-pause")
    assert picture(page) == held
    page.click("#curves-pause")
    page.wait_for(lambda: first in drives(page)[1:], "both drives")
    pictures = []
    button = page.element(f"curves-drive-{first.split()[1]}")
    for pressed in "false", "true":
        button.click()
        page.wait_for(lambda pressed=pressed: button.get_attribute("aria-pressed") == pressed, f"{first}: {pressed}")
        pictures.append(picture(page))
    assert pictures[0] != pictures[1]


def test_on_a_phones_pad_curves_take_the_maps_place_and_their_colours_stand_out(page, world):
    show_curves(page)
    world.drive(page, ROBOT, 1, 0.4)
    page.wait_for(lambda: drives(page) == ["Drive 1"], "a drive")
    world.drive_until(lambda: "left 0." in values(page) and "left 0.00" not in values(page), page)
    page.lift()
    try:
        for scheme in "dark", "light":
            page.media(prefers_color_scheme=scheme)
            page.wait_for(lambda: min(page.run(COLOURS, ["--curve-0", "--curve-1"])) > 20, f"both curves, {scheme}")
    finally:
        page.media()
    assert not page.element("map").is_displayed()
    page.click("#curves-close")
    page.wait_for(lambda: page.element("map").is_displayed() and not page.element("curves").is_displayed(), "the map")


def test_a_drive_is_read_by_keys_that_drive_nothing_and_by_a_finger_that_zooms_and_gets_its_score(page, world):
    show_curves(page)
    world.drive_until(lambda: drives(page) == ["Drive 1"], page)
    page.lift()
    page.wait_for(lambda: "Speed: 0.00 m/s" in values(page), "the robot to stand")
    page.tab_to("curves-moment")
    with world.stops(ROBOT, what="the arrow keys moved the moment"):
        page.tap("Home")
        page.wait_for(lambda: values(page).startswith("0.0 s; Wheels: left "), "the beginning")
        page.tap("ArrowRight")
        page.wait_for(lambda: page.value("curves-moment") == "0.01", "the next moment")
    x, y = page.place_of("#curves canvas")
    page.touch_event("touchStart", (x, y))
    page.touch_event("touchEnd")
    page.wait_for(lambda: values(page)[:5] != "0.0 s", "a moment")
    before = picture(page)
    page.touch_event("touchStart", (x - 20, y), (x + 20, y))
    page.touch_event("touchMove", (x - 80, y), (x + 80, y))
    page.touch_event("touchEnd")
    page.wait_for(lambda: picture(page) != before, "another part of the time")
    page.click("#curves-fit")
    task = {"name": "metre", "title": "One metre", "state": "driving", "text": "", "seconds": 1.0, "score": None,
            "sentences": [], "lost": None}
    page.receive_class(2, task=task)
    page.wait_for_text("task", "One metre")
    page.receive_class(2, task={**task, "state": "done", "score": 87.3})
    page.wait_for(lambda: drives(page) == ["Drive 1: 87.3"], "its score")


def length(page):
    """Return how long the drive is, in s, as a text."""
    return page.run("return document.getElementById('curves-moment').max")


def test_after_a_lost_connection_and_with_another_robot_values_come_again(page):
    show_curves(page)
    page.run("socket.close()")
    page.wait_for(lambda: "ms" not in page.text("link"), "the page to notice")
    page.wait_for_link()
    before = length(page)
    page.wait_for(lambda: length(page) != before, "new values")
    page.choose(OTHER_ROBOT)
    page.wait_for(lambda: length(page) == "0", "the other robot's curves")
    page.wait_for(lambda: length(page) != "0" and "Wheels: left 0.00" in values(page), "its values")


def test_the_curves_fit_each_screen_and_break_no_rule_of_accessibility(page):
    show_curves(page)
    for screen in [*TOUCH_SCREENS, DESKTOP]:
        page.resize(*screen, touch=screen != DESKTOP)
        page.wait_for(lambda: page.fits("pad", "stop", "curves-pause"), f"all on {screen}")
        assert page.small_controls(FINGER) == [], screen
        assert page.run("return document.querySelector('#curves .plot').clientHeight") > 60, screen
    assert violations(page) == []


def test_curves_that_cannot_be_loaded_are_named_and_pressed_twice_while_they_load_there_is_one_panel(page):
    page.driver.execute_cdp_cmd("Network.enable", {})
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": ["*/panel.js"]})
    page.run("document.getElementById('show-curves').click()")
    page.wait_for_text("notice", "This could not be loaded. Try again.")
    page.driver.execute_cdp_cmd("Network.setBlockedURLs", {"urls": []})
    page.run("const button = document.getElementById('show-curves'); button.click(); button.click();")
    page.wait_for(lambda: page.has("#curves canvas") and "Wheels" in values(page), "the curves")
    page.click("#curves-close")
    page.wait_for(lambda: page.element("map").is_displayed(), "the map")
    assert page.run("return [...document.querySelectorAll('#curves')].map(each => each.hidden)") == [True]


def test_beside_the_blocks_they_break_none_either_and_have_room(blocks, world):
    page = blocks(TURNS)
    show_curves(page)
    run(page, world)
    for screen in TABLET, TABLET[::-1]:
        page.resize(*screen)
        assert page.outside("#curves .controls button", "#curves") == [], screen
        assert page.run("return document.querySelector('#curves .plot').clientHeight") > 200, screen
    page.resize(*TABLET)
    assert violations(page) == []
    page.resize(390, 844)
    assert not page.element("curves").is_displayed() and page.text("outcome") == "The program has ended."
    page.resize(*TABLET)
    page.click("#show-curves")
    assert page.element("python").is_displayed() and not page.element("curves").is_displayed()
