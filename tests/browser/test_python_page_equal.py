"""The same file drives a robot by rosrun and in the page: the same commands in the same order, to the same place.

Each takes a quarter of a minute, so not all run each time. All of them: ./morbot test FILE --long.
"""

import math
import sys
import time
from pathlib import Path
from typing import List, NamedTuple, Optional, Tuple

import pytest
from lesson_pages import boxes

from harness import START_TIMEOUT
from harness import program as installed
from processes import end

from .conftest import ROBOT, some
from .programs import program
from .wheels import WRITING
from .world import World, moving

ROOT = Path(__file__).parents[2]
DISTANCE, ANGLE = 0.02, math.radians(5)  # by which the places may differ, in m and rad
SPEED, DURATION = 0.003, 0.1  # by which the speeds of a wheel may differ, and for how many s they are driven
LONGEST = 30  # s
GROUND_TRUTH = f"/{ROBOT}/jetbot_simulator/ground_truth/pose/pose"
ENDLESS = {"zigzag.py": 2.5, "jetbot_motion_control.py": 1.5}  # s after which they are stopped
LOOPS = ["eyes.py"]  # steers by what it sees a moment earlier or later, so its speeds differ


def texts():
    """Return the programs by their files' names: also those of lessons, lesson 9's with its exercise's answer."""
    lessons = {box.file.rpartition("/")[2]: box.text for lesson in ("7_your_package", "9_task")
               for box in boxes(ROOT / f"docs/lessons/{lesson}.md") if (box.file or "").endswith(".py")}
    files = [*(ROOT / "tests/programs").glob("*.py"),
             ROOT / "morbot_ws/src/scenarios/workshop/scripts/jetbot_motion_control.py"]
    return {**{file.name: file.read_text() for file in files}, **lessons,
            "metre.py": lessons["metre.py"].replace("COMMANDS = 20", "COMMANDS = 33")}


TEXTS = texts()


class Drive(NamedTuple):
    """The speeds of both wheels, for how many s each pair was driven, and the place at the end: x, y, yaw."""

    speeds: List[Tuple[float, float]]
    durations: List[float]
    place: Tuple[float, float, float]


class Track(World):
    """A world whose robot can be put at the beginning of a line again."""

    def put_back(self) -> None:
        """Put the robot at the line's beginning."""
        end([each for each in self._processes if "simulator" in str(each.args)])
        bus = f"_i2c_bus:=fake:{self._folder / ROBOT}"
        self.start(installed("simulation", "simulator.py"), f"__ns:=/{ROBOT}", bus, "_world:=line.yaml")
        self.poses = self.start("rostopic", "echo", "-p", GROUND_TRUTH)  # of the simulator, too
        self.wait_for(self.place, START_TIMEOUT, "the robot's place")

    def place(self) -> Optional[Tuple[float, float, float]]:
        """Return where the robot stands; None as long as it moves."""
        *lines, _ = self.poses.log.read_text().split("\n")
        last = {line.partition(",")[2] for line in lines[-3:]}
        if len(lines) < 5 or len(last) > 1:
            return None
        x, y, _, _, _, z, w = map(float, last.pop().split(","))
        return x, y, 2 * math.atan2(z, w)

    def driven(self, start: float) -> Drive:
        """Return what was driven since this time, once the robot stands."""
        self.wait_for_stop(ROBOT)
        self.wait_for(self.place, START_TIMEOUT, "the robot's place")
        speeds, durations = [], []
        changes = self.record.since(ROBOT, start)
        for change, after in zip(changes, changes[1:]):
            duration = after.time - change.time
            if speeds and (duration < WRITING or close(change.speeds, speeds[-1])):
                durations[-1] += duration
            else:
                speeds.append(change.speeds)
                durations.append(duration)
        return Drive(speeds, durations, self.place())

    def moves_for(self, seconds: float, start: float) -> None:
        """Wait until the robot has driven for so many s."""
        self.wait_for(lambda: any(moving(*change.speeds) and time.time() - change.time > seconds
                                  for change in self.record.since(ROBOT, start)), LONGEST, "the robot to drive")


def close(one, other):
    return all(abs(a - b) < SPEED for a, b in zip(one, other))


@pytest.fixture(scope="module")
def world(tmp_path_factory):
    """One robot and a cockpit."""
    world = Track(tmp_path_factory.mktemp("track"), ROBOT)
    yield world
    world.close()


def by_rosrun(world, name, file):
    """Drive as rosrun does, which starts the file with Python."""
    world.put_back()
    world.wait_until_free(ROBOT)
    start = time.time()
    process = world.start(sys.executable, str(file), f"__ns:=/{ROBOT}")
    if name in ENDLESS:
        world.moves_for(ENDLESS[name], start)
        end([process])
    else:
        world.wait_for(lambda: process.poll() is not None, LONGEST, f"the end of {process.log.read_text()}")
    return world.driven(start), process.log.read_text().splitlines()


def in_page(world, name, page):
    """Drive in the page."""
    world.put_back()
    start = time.time()
    page.click("#run")
    if name in ENDLESS:
        world.moves_for(ENDLESS[name], start)
        page.click("#end")
    else:
        page.wait_for(lambda: any(each in page.text("outcome") for each in ("has ended", "interrupted")), "its end")
        assert "The program has ended." in page.text("outcome")
    return world.driven(start), page.text("prints").splitlines()


def compare(name, here, page):
    """Fail unless both drives are the same."""
    (ours, said), (theirs, printed) = page, here
    report = f"\nin the page: {ours} {said}\nby rosrun:   {theirs} {printed}"
    assert "\n".join(said).strip() == "\n".join(printed).strip(), report
    if name not in LOOPS:
        assert len(ours.speeds) == len(theirs.speeds), report
        assert all(map(close, ours.speeds, theirs.speeds)), report
    if name not in [*LOOPS, *ENDLESS]:
        assert ours.durations == pytest.approx(theirs.durations, abs=DURATION), report
    if name not in ENDLESS:
        assert math.dist(ours.place[:2], theirs.place[:2]) < DISTANCE, report
        assert abs(math.remainder(ours.place[2] - theirs.place[2], math.tau)) < ANGLE, report


@pytest.mark.parametrize("name", some(sorted(TEXTS), "jetbot_motion_control.py"))
def test_a_file_drives_in_the_page_as_by_rosrun(name, blocks, world, tmp_path):
    file = tmp_path / name
    file.write_text(TEXTS[name])
    page = blocks({**program(), "python": TEXTS[name]})
    world.undisturbed(page, lambda: compare(name, by_rosrun(world, name, file), in_page(world, name, page)))
