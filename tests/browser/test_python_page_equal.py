"""The same file drives a robot by rosrun and in the page: the same speeds in the same order, as far, and it prints the
same. Each takes a quarter of a minute, so one runs each time. All of them: ./morbot test FILE --long.
"""

import math
import sys
import time
from pathlib import Path

import pytest
from lesson_pages import boxes

from processes import end

from .conftest import ROBOT, some
from .programs import program
from .test_program import close
from .wheels import WRITING
from .world import moving

ROOT = Path(__file__).parents[2]
WAY = 0.06   # by which the ways of a wheel may differ: full speed for 0.06 s
LONGEST = 30  # s
ENDLESS = {"zigzag.py": 2.5, "jetbot_motion_control.py": 1.5}  # s after which they are stopped
LESSONS = {box.file.rpartition("/")[2]: box.text for lesson in ("7_your_package", "9_task")
           for box in boxes(ROOT / f"docs/lessons/{lesson}.md") if (box.file or "").endswith(".py")}
FILES = [*(ROOT / "tests/programs").glob("*.py"),
         ROOT / "morbot_ws/src/scenarios/workshop/scripts/jetbot_motion_control.py"]
TEXTS = {**LESSONS, **{file.name: file.read_text() for file in FILES}}


def driven(world, since):
    """Return the speeds of both wheels in their order, and how far each wheel has turned, since this time."""
    changes, speeds, ways = world.record.since(ROBOT, since), [], [0.0, 0.0]
    for change, after in zip(changes, changes[1:]):
        seconds = after.time - change.time
        if seconds > WRITING and not (speeds and close(change.speeds, speeds[-1])):
            speeds.append(change.speeds)
        ways = [way + speed * seconds for way, speed in zip(ways, change.speeds)]
    return speeds, ways


def drive(world, name, begin, over, stop):
    """Begin, wait until that is over, or has driven for long enough; return what was driven."""
    world.wait_until_free(ROBOT)
    start, enough = time.time(), ENDLESS.get(name, math.inf)
    begin()
    world.wait_for(lambda: over() or any(moving(*change.speeds) and time.time() - change.time > enough
                                         for change in world.record.since(ROBOT, start)), LONGEST, f"the end of {name}")
    stop()
    world.wait_for_stop(ROBOT)
    return driven(world, start)


@pytest.mark.parametrize("name", some(sorted(TEXTS), "jetbot_motion_control.py"))
def test_a_file_drives_in_the_page_as_by_rosrun(name, blocks, world, tmp_path):
    file = tmp_path / name
    file.write_text(TEXTS[name])
    page = blocks({**program(), "python": TEXTS[name]})

    def compare():
        nodes = []
        theirs = drive(world, name, lambda: nodes.append(world.start(sys.executable, str(file), f"__ns:=/{ROBOT}")),
                       lambda: nodes[0].poll() is not None, lambda: end(nodes))
        ours = drive(world, name, page.start_program, lambda: "Running" not in page.text("outcome"),
                     lambda: name in ENDLESS and page.click("#end"))
        assert name in ENDLESS or "The program has ended." in page.text("outcome")
        assert page.text("prints") == nodes[0].log.read_text().strip()
        assert len(ours[0]) == len(theirs[0]) and all(map(close, ours[0], theirs[0])), f"{ours} {theirs}"
        assert name in ENDLESS or ours[1] == pytest.approx(theirs[1], abs=WAY), f"{ours} {theirs}"
    world.undisturbed(page, compare)
