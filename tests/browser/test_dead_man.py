"""The server's switch: it stops a robot whose page can no longer say so. cmd_vel_timeout is 0: nothing else would."""

import signal

import pytest

from .conftest import ROBOT


@pytest.fixture
def victim(world, browsers):
    """A browser that may be killed, which drives."""
    victim = browsers("victim")
    victim.open(world.address, ROBOT)
    world.drive(victim, ROBOT)
    return victim


def test_a_browser_that_freezes_and_continues_drives_only_after_the_finger_has_lifted(victim, world):
    victim.signal(signal.SIGSTOP)
    world.wait_for_stop(ROBOT)
    victim.signal(signal.SIGCONT)
    world.stays_stopped(ROBOT, 1.0)
    victim.move(0.9, 0.1)
    world.stays_stopped(ROBOT)
    victim.wait_for_link()
    world.drive(victim, ROBOT)
    victim.lift()
    world.wait_for_stop(ROBOT)


def test_a_page_that_hangs(victim, world):
    victim.run("setTimeout(() => { for (const end = Date.now() + 1500; Date.now() < end;); })")
    world.wait_for_stop(ROBOT)
    world.stays_stopped(ROBOT, 2.0)
    world.drive(victim, ROBOT)
    victim.lift()
    world.wait_for_stop(ROBOT)


def test_a_browser_that_is_killed(victim, world):
    victim.signal(signal.SIGKILL)
    world.wait_for_stop(ROBOT)
    world.stays_stopped(ROBOT)


def test_a_cockpit_that_is_killed_and_restarted(page, world):
    world.drive(page, ROBOT)
    world.kill(world.cockpit)
    world.wait_for_stop(ROBOT)
    page.wait_for(lambda: "connect" in page.text("notice") + page.text("status"), "a sentence about the connection")
    world.start_cockpit()
    page.wait_for_link()
    page.move(0.9, 0.1)
    world.stays_stopped(ROBOT)
    world.drive(page, ROBOT)
    page.lift()
    page.errors()  # refused connections
