"""The recipe for a board in CONTRIBUTING.md, followed as it is written."""

import re

import pytest

from conftest import ROOT
from jetbot import boards
from jetbot.fake import motors
from jetbot.fake.bus import power_on

RECIPE = (ROOT / "CONTRIBUTING.md").read_text().split("## A board")[1].split("\n## ")[0]


@pytest.fixture
def myboard(monkeypatch):
    """The name of the board that the recipe adds."""
    rows = re.findall(r"```python\n(.*?)```", RECIPE, re.S)
    for table, module, row in zip((boards.BOARDS, motors.ROBOTS), (boards, motors), rows):
        for name, board in eval(f"{{{row}}}", dict(vars(module))).items():
            monkeypatch.setitem(table, name, board)
    return "myboard"


def test_a_board_is_two_rows(myboard, folder):
    power_on(folder)
    driver = boards.BOARDS[myboard].open(f"fake:{folder}")
    for speeds in ((0.5, -0.25), (-1, 1), (0, 0)):
        driver.drive(*speeds)
        assert motors.wheel_speeds(folder, myboard) == speeds
