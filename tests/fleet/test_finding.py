"""A network gives robots other addresses, which no list knows: they are found by what avahi announces."""

import shutil
import time
from importlib.util import find_spec

import pytest
from school import CLASS

from jetbot_class.robot.service import XML
from jetbot_ros.contract import COCKPIT_PORT

AVAHI = shutil.which("avahi-daemon", path="/usr/sbin:/usr/bin")
SETTINGS = "[server]\nenable-dbus=no\nallow-interfaces=eth0\n"
NEW = 50  # is added to the number of each address


@pytest.fixture
def announced(lesson):
    """A lesson whose first two robots announce themselves."""
    for robot in lesson.first, lesson.second:
        (robot.folder / "avahi").mkdir(exist_ok=True)
        (robot.folder / "avahi.conf").write_text(SETTINGS)
        (robot.folder / "avahi/morbot.service").write_text(
            XML.format(robot=robot.name, port=COCKPIT_PORT, class_name=CLASS))
        robot.host.run("mount", "--bind", str(robot.folder / "avahi"), "/etc/avahi/services")
        robot.host.start([AVAHI, "-f", str(robot.folder / "avahi.conf"), "--no-drop-root", "--no-chroot",
                          "--no-rlimits"], robot.folder / "avahi.log", {})
    yield lesson
    for robot in lesson.first, lesson.second:
        robot.host.run("/usr/sbin/avahi-daemon", "--kill")
        robot.host.run("umount", "/etc/avahi/services")
        robot.host.move(robot.number)
    lesson.school.list_robots()


@pytest.mark.skipif(not (AVAHI and find_spec("zeroconf")), reason="needs avahi-daemon and python3-zeroconf")
def test_robots_with_new_addresses_are_found_and_do_not_turn(announced):
    robots = announced.first, announced.second
    for robot in robots:
        robot.host.move(robot.number + NEW)
    for robot in robots:
        announced.stops(robot, time.monotonic(), "new address")
    announced.is_back("new addresses", *robots)
    for robot in robots:
        announced.press(robot)
