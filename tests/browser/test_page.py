"""The page fits the screen, and works with a keyboard alone and with a screen reader."""

import pytest

from .conftest import ROBOT

SCREENS = {"phone": (390, 844), "phone on its side": (844, 390), "small phone": (360, 640), "desktop": (1280, 800)}


@pytest.mark.parametrize("screen", SCREENS.values(), ids=SCREENS)
def test_pad_and_stop_are_on_the_screen_without_scrolling(screen, page, pupil):
    for each in page, pupil:
        each.screen(*screen)
        each.wait_for(lambda each=each: each.run("return [innerWidth, innerHeight]") == list(screen), "this screen")
        assert each.run("return document.documentElement.scrollWidth") <= screen[0]
        for name in "pad", "stop", "status", "map":
            assert each.is_on_screen(name), f"#{name} is not on the screen"


def test_the_tab_key_reaches_every_control(page):
    reached = page.tab_through()
    controls = page.controls()
    assert {"stop", "release", "robot", "speed", "name"} <= set(filter(None, controls))
    assert not [name for name in controls if name and name not in reached]


def test_each_control_has_a_name_for_a_screen_reader(page):
    assert all(page.element(name).accessible_name for name in page.controls() if name)
    for name in "pad", "map", "wheels":
        assert page.element(name).accessible_name, f"#{name} has no label"
    assert page.element("status").get_attribute("aria-live") or page.element("status").aria_role == "status"


def test_nothing_comes_from_another_host(page, world):
    urls = page.run("return performance.getEntriesByType('resource').map(entry => entry.name)")
    assert urls and all(url.startswith(world.address) for url in urls)
    assert page.element("robot").is_displayed() and ROBOT in str(page.robots())
