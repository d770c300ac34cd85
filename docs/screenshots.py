#!/usr/bin/env python3
"""Takes the pictures of the cockpit in docs: real nodes, a real cockpit, and a headless Chromium that drives.

Type: ./morbot shell docs/screenshots.py [PICTURE ...]. It needs chromium, chromium-driver, python3-selenium and
imagemagick.
"""

import contextlib
import os
import subprocess
import sys
import tempfile
import threading
import time
import urllib.request
from pathlib import Path
from typing import Iterator, Tuple

import rospy
from geometry_msgs.msg import Twist

DOCS = Path(__file__).resolve().parent
sys.path += [str(DOCS.parent / "tests"), str(DOCS.parent / "tests/ros")]
from browser import programs  # noqa: E402
from browser.page import Page  # noqa: E402

from processes import end, end_on_sigterm, free_port, start  # noqa: E402

PHONE, TABLET, DESKTOP = (390, 844, 2), (1024, 768, 1), (1280, 800, 1)  # width, height in CSS pixels; pixels per one
UPRIGHT = (768, 1024, 1)  # the tablet
PICTURES = ["cockpit_desktop.png", "cockpit_phone.png", "cockpit_class.png", "program_tablet.png", "program_map.png",
            "curves.png", "python_tablet.png"]
COLORS = 128            # of a PNG
START_TIMEOUT = 120.0   # s
STEP = 0.5              # s
CLASS = 15
EIGHT = [(0.9, 0.25, 9.5), (0.9, -0.25, 7.5)]  # what the pad is given: forward, left, s
SIDE = 2.0              # s, of the lesson's square
RAMP = """import rospy
from geometry_msgs.msg import Twist

rospy.init_node("my_ramp")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rate = rospy.Rate(10)
motion = Twist()

for step in range(1, 6):
    motion.linear.x = step / 10
    print("x", motion.linear.x)
    for count in range(8):
        publisher.publish(motion)
        rate.sleep()
"""
ONE = ["simulation", "simulation.launch", "cockpit:=true", "rviz:=false"]


def main() -> None:
    end_on_sigterm()  # the nodes and the browser, too
    wanted = sys.argv[1:] or PICTURES
    if "cockpit_desktop.png" in wanted:
        with launched(*ONE) as address:
            take(address, DESKTOP, "cockpit_desktop.png")
    if "cockpit_phone.png" in wanted:
        with launched(*ONE) as address:
            take(address, PHONE, "cockpit_phone.png")
    if "cockpit_class.png" in wanted:
        with launched("jetbot_class", "class.launch", f"robots:={CLASS}") as address, others_drive():
            take(address, DESKTOP, "cockpit_class.png", CLASS)
    if "program_tablet.png" in wanted:
        with launched(*ONE) as address:
            take_program(f"{address}/program", TABLET, "program_tablet.png", turn=1)
    if "program_map.png" in wanted:
        with launched(*ONE) as address:
            take_program(f"{address}/program", UPRIGHT, "program_map.png", turn=1.47, sides=3)
    if "curves.png" in wanted:
        with launched(*ONE) as address:
            take_curves(f"{address}/program", TABLET, "curves.png")
    if "python_tablet.png" in wanted:
        with launched(*ONE) as address:
            take_text(f"{address}/program", TABLET, "python_tablet.png")


@contextlib.contextmanager
def launched(package: str, file: str, *arguments: str) -> Iterator[str]:
    """Run a launch file, with a master and a port of its own. Return the page's address."""
    port = free_port()
    os.environ.update(ROS_MASTER_URI=f"http://localhost:{free_port()}", ROS_HOSTNAME="localhost")
    with tempfile.TemporaryDirectory() as home:
        option = "port" if package == "jetbot_class" else "cockpit_port"
        command = ["roslaunch", package, file, *arguments, f"{option}:={port}"]
        process = start(command, Path(home, "roslaunch.log"), env={**os.environ, "HOME": home, "ROS_HOME": home})
        try:
            wait_for_page(f"http://localhost:{port}")
            yield f"http://localhost:{port}"
        except TimeoutError:
            print(process.log.read_text())
            raise
        finally:
            end([process])


def wait_for_page(address: str) -> None:
    """Wait until the cockpit answers; raise TimeoutError if it does not start."""
    deadline = time.monotonic() + START_TIMEOUT
    while time.monotonic() < deadline:
        with contextlib.suppress(OSError), urllib.request.urlopen(address):
            return
        time.sleep(0.2)
    raise TimeoutError(f"no cockpit at {address}")


def take(address: str, size: Tuple[int, int, int], name: str, robots: int = 1) -> None:
    """Open the page, drive an eight with the pad, a circle in a class, and save what the page shows meanwhile."""
    with opened(address, size, robots) as page:
        for forward, left, seconds in EIGHT if robots == 1 else EIGHT[:1]:
            drive(page, forward, left, seconds)
        if robots > 1:
            page.run("document.getElementById('fit').click()")
            time.sleep(STEP)
        save(page, DOCS / name)


def take_program(address: str, size: Tuple[int, int, int], name: str, turn: float, sides: int = 0) -> None:
    """Run the square of the lesson, with turns of so many seconds; save what the page shows after so many sides."""
    with opened(address, size) as page, tempfile.TemporaryDirectory() as folder:
        page.element("file").send_keys(programs.as_file(Path(folder), square(turn)))
        page.type("title", "square")
        page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
        page.click("#run")
        page.wait_for(lambda: page.text_of("#python .now").startswith("drive(0.5"), "the first side to run")
        if sides:
            page.click("#show-map")
            time.sleep(sides * (SIDE + turn) + STEP)
        save(page, DOCS / name)


def take_curves(address: str, size: Tuple[int, int, int], name: str) -> None:
    """Drive two squares that differ in their turns, and save their curves."""
    with opened(address, size) as page, tempfile.TemporaryDirectory() as folder:
        page.click("#show-curves")
        for turn in 1.2, 1.47:
            page.element("file").send_keys(programs.as_file(Path(folder), square(turn)))
            page.wait_for_text("outcome", "Press Run.")
            page.click("#run")
            page.wait_for_text("outcome", "The program has ended.")
            time.sleep(3 * STEP)
        save(page, DOCS / name)


def take_text(address: str, size: Tuple[int, int, int], name: str) -> None:
    """Let a text jump to half of the power, then rise to it; save what the page shows when it is nearly there."""
    with opened(address, size) as page, tempfile.TemporaryDirectory() as folder:
        for first, shown in (5, "x 0.5"), (1, "x 0.4"):
            content = {**programs.program(), "python": RAMP.replace("range(1", f"range({first}")}
            page.element("file").send_keys(programs.as_file(Path(folder), content))
            page.type("title", "ramp")
            if first == 5:
                page.click("#show-curves")  # not before the text, whose place is that of the blocks
            page.wait_for(lambda: page.text("kept") == "Kept", "it to be kept")
            page.click("#run")
            page.wait_for_text("prints", shown)
            time.sleep(STEP)
            if first == 1:
                save(page, DOCS / name)
            page.wait_for_text("outcome", "The program has ended.")
            time.sleep(3 * STEP)


def square(turn: float) -> dict:
    """Return a program of four sides, with turns of so many seconds."""
    corner = programs.block("robot_turn", {"SIDE": "LEFT"}, Z=programs.num(0.1), SECONDS=programs.num(turn))
    return programs.program(programs.block(
        "controls_repeat_ext", TIMES=programs.num(4), DO=programs.chain(programs.drive(0.5, SIDE), corner)))


@contextlib.contextmanager
def opened(address: str, size: Tuple[int, int, int], robots: int = 1) -> Iterator[Page]:
    """Open a page in light colours, on a screen of this size, with so many robots."""
    width, height, scale = size
    with tempfile.TemporaryDirectory() as profile, contextlib.closing(Page(Path(profile))) as page:
        page.media(prefers_color_scheme="light")
        page.open(address)
        page.screen(width, height, touch=width < height, scale=scale)
        page.driver.execute_cdp_cmd("Emulation.setScrollbarsHidden", {"hidden": True})
        page.wait_for(lambda: len(page.robots()) == robots, "all robots", START_TIMEOUT)
        yield page


def drive(page: Page, forward: float, left: float, seconds: float) -> None:
    """Push the pad until the robot has driven for so long; on a busy computer, the dead man's switch may stop it."""
    page.touch(forward, left)
    driven = 0.0
    while driven < seconds or page.text("notice"):
        time.sleep(STEP)
        if page.text("status").startswith("driving"):
            driven += STEP
        else:
            page.touch(forward, left)


def save(page: Page, path: Path) -> None:
    png = page.driver.get_screenshot_as_png()
    subprocess.run(["convert", "png:-", "-strip", "+dither", "-colors", str(COLORS), f"PNG8:{path}"],
                   input=png, check=True)
    print(f"{path.name}: {path.stat().st_size / 1000:.0f} kB")


@contextlib.contextmanager
def others_drive() -> Iterator[None]:
    """All robots of the class but the first one drive circles of their own, without the cockpit."""
    rospy.init_node("pupils", disable_signals=True)
    publishers = [rospy.Publisher(f"/jetbot_{number:02}/cmd_vel", Twist, queue_size=1)
                  for number in range(2, CLASS + 1)]
    ended = threading.Event()

    def publish():
        while not ended.wait(0.1):
            for number, publisher in enumerate(publishers):
                motion = Twist()
                motion.linear.x, motion.angular.z = 0.4, 0.06 + 0.004 * number
                publisher.publish(motion)

    thread = threading.Thread(target=publish)
    thread.start()
    try:
        yield
    finally:
        ended.set()
        thread.join()


if __name__ == "__main__":
    main()
