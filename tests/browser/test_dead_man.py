"""The server's switch: it stops a robot whose page can no longer say so. cmd_vel_timeout is 0: nothing else would."""

import signal
import time

from .conftest import OTHER_ROBOT, ROBOT
from .world import LONGEST_GAP, moving


def test_a_browser_that_freezes_drives_only_after_the_finger_has_lifted_and_the_teacher_sees_it(page, victim, world):
    freeze(victim, world)
    world.stay_stopped(ROBOT)
    victim.move(0.9, 0.1)
    world.stay_stopped(ROBOT)
    victim.lift()
    world.drive(victim, ROBOT)
    freeze(victim, world)
    victim.lift()
    page.click("#show-fleet")
    page.wait_for_text("fleet", "network stalls")
    assert "network stalls" not in page.text_of(f"#fleet li[data-robot='/{OTHER_ROBOT}']")


def freeze(victim, world):
    """Freeze the browser until the robot has stopped."""
    try:
        with world.stops(ROBOT, what="SIGSTOP of the browser"):
            victim.signal(signal.SIGSTOP)
    finally:
        victim.signal(signal.SIGCONT)


def test_the_switch_does_not_fire_while_a_finger_drives(page, world):
    def drive():
        world.drive(page, ROBOT, wanted=lambda left, right: left > 0.4)
        start = time.time()
        world.stay(moving, ROBOT, for_seconds=1.0)
        assert world.record.since(ROBOT, start) == [], f"gaps of {LONGEST_GAP} s at most do not stop a robot"
        assert len([each for each in page.sent() if each.time > start]) > 15, "the page sends 20 commands per second"
    world.undisturbed(page, drive)


def test_a_cockpit_that_is_killed_and_restarted(page, world):
    world.drive(page, ROBOT)
    with world.stops(ROBOT, what="SIGKILL of the cockpit"):
        world.kill(world.cockpit)
    page.wait_for_text("status", "no connection")
    world.start_cockpit()
    page.wait_for_link()
    page.move(0.9, 0.1)
    world.stay_stopped(ROBOT)
    page.lift()
    world.drive(page, ROBOT)
    page.errors()  # refused connections


def test_a_browser_that_is_killed(victim, world):
    with world.stops(ROBOT, what="SIGKILL of the browser"):
        victim.signal(signal.SIGKILL)
