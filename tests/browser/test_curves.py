"""The curves show what the robot reported, as a rosbag of the same drive has it."""

import csv
import time

import pytest

from .conftest import ROBOT
from .programs import block, drive, num, program


def test_look(blocks, world):
    page = blocks(program(drive(0.5, 1), block("robot_turn", {"SIDE": "LEFT"}, Z=num(0.3), SECONDS=num(1.5)),drive(0.8, 1)))
    page.click("#show-curves")
    page.wait_for(lambda: page.has("#curves canvas"), "the curves")
    for n in range(2):
        page.click("#run")
        page.wait_for_text("outcome", "The program has ended.")
        time.sleep(1.5)
        page.driver.save_screenshot(f"/tmp/curves_{n}.png")
    for b in ["Heading", "Eyes", "Battery"]:
        page.run("[...document.querySelectorAll('#curves button')].find(e => e.textContent === arguments[0]).click()", b)
    time.sleep(.5)
    page.driver.save_screenshot("/tmp/curves_2.png")
    print(page.errors())
