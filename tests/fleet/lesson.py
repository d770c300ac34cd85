"""All robots are driven: two through the hub, by a page each, and the others by their pupils' tablets, directly."""

import time
from typing import Callable, List

from school import BACK, Robot, School
from wheels import MAX_DELAY, p95

from jetbot.wait import wait_until

SETTLE = 1.5    # s in which delays are measured
MIN_DELAYS = 15 # of 30 commands that were sent meanwhile
NUMBERS: List[str] = []  # what was measured
STOP_BOUND = 0.3 + 0.25  # s: the dead man's switch, and generously what the robot and this computer take
LATER = 0.15    # s by which another robot's commands may be late on a busy computer


def measured(what: str, value: float) -> float:
    """Report a number of s at the end of the tests; return it."""
    NUMBERS.append(f"{what}: {1000 * value:.0f} ms")
    return value


class Lesson:
    """first, second: driven through the hub; third and rest: directly. teacher: a page of the hub that drives none."""

    def __init__(self, school: School):
        self.school, self.wheels = school, school.wheels
        self.first, self.second, self.third = school.robots[:3]
        self.teacher = school.hub.page()
        self.pages = {robot.name: school.hub.page() if robot in school.robots[:2] else school.tablet(robot)
                      for robot in school.robots}
        for robot in school.robots:
            page = self.pages[robot.name]
            page.wait(lambda page=page, robot=robot: page.robot(robot.name).get("answers"), 10.0, robot.name)
            self.press(robot)

    def press(self, robot: Robot) -> None:
        """Put the finger of the robot's driver on the pad, again if that is refused, until the robot drives."""
        page, start = self.pages[robot.name], time.monotonic()
        while not self.wheels.turned(robot.name, start):
            assert time.monotonic() < start + BACK, f"{robot.name} cannot be driven: {page.said[-3:]}"
            if not page.presses:
                page.press(robot.name)
            time.sleep(0.05)

    def p95(self, robot: Robot) -> float:
        """Return the 95th percentile of the delays of the commands that move the robot from now on, in s."""
        page, start = self.pages[robot.name], time.monotonic()
        while time.monotonic() < start + SETTLE + MAX_DELAY:
            if not page.presses:  # this computer was so busy that the robot stopped: a person presses again
                page.press(robot.name)
            time.sleep(0.05)
        commands = [each for each in page.commands if start < each[0] < start + SETTLE]
        delays = self.wheels.delays(robot.name, commands)
        assert len(delays) >= MIN_DELAYS, f"{robot.name} obeyed {len(delays)} commands; {page.said[-3:]}"
        return p95(delays)

    def others_notice_nothing(self, what: str, harm: Callable[[], None], robot: Robot) -> None:
        """Do harm; fail if this robot's commands are late from then on."""
        before = self.p95(robot)
        harm()
        after = self.p95(robot)
        NUMBERS.append(f"{what}: p95 of another robot {1000 * before:.1f} ms before, {1000 * after:.1f} ms then")
        assert after < before + LATER

    def stops(self, robot: Robot, since: float, what: str, bound: float = STOP_BOUND) -> None:
        """Fail unless the robot stops so soon after this time."""
        assert wait_until(lambda: not self.wheels.turn(robot.name), since + bound - time.monotonic()), \
            f"{robot.name} turns {bound} s later"
        measured(f"{what}: {robot.name} stopped after", max(0.0, self.wheels.stopped_at(robot.name) - since))

    def is_back(self, what: str, *stopped: Robot) -> None:
        """Fail unless the hub has all robots within BACK, and those that had stopped have not turned by themselves."""
        start = time.monotonic()
        pages = [self.teacher, *self.pages.values()]
        measured(f"{what}: all back after", self.teacher.wait(
            lambda: all(page.state for page in pages) and self.school.answer(self.teacher), BACK, "all robots"))
        for robot in stopped:
            assert not self.wheels.turned(robot.name, start), f"{robot.name} turned by itself"

    def close(self) -> None:
        for page in (self.teacher, *self.pages.values()):
            page.close()
