"""The cockpit's page is complete, and needs nothing that its Content-Security-Policy forbids."""

import re

import pytest

from conftest import ROOT
from jetbot.health import FACTS

PAGES = pytest.importorskip("jetbot_cockpit.web.handlers").PAGES  # it needs Tornado
WWW = ROOT / "morbot_ws/src/jetbot_cockpit/www"
PAGE, PROGRAM = ((WWW / name).read_text() for name in ("index.html", "program.html"))
PADS, PROGRAMS = (sorted(WWW.glob(names)) for names in ("*.js", "program/*.js"))
SCRIPTS = PADS + PROGRAMS
LIGHT, DARK = (dict(re.findall(r"--([\w-]+): (#\w{6})", block))
               for block in re.findall(r":root \{(.*?)\}", (WWW / "style.css").read_text(), re.S))
ALL = "ground surface calm-ground"
TEXTS = {"text": f"{ALL} good-ground warn-ground bad-ground", "muted": f"{ALL} good-ground warn-ground bad-ground",
         "accent": ALL, "good": "ground surface good-ground", "warn": "ground surface warn-ground",
         "bad": "ground surface bad-ground", "surface": "accent", "white": "stop stop-pressed"}
GRAPHICS = {"edge": ALL, "accent": ALL, "muted": ALL, "commanded": "ground surface", "actual": "ground surface",
            "course": "ground surface", "stop": "ground", "tyre": "ground"}  # edge: of controls; accent: of the focus
FIXED = {"white": "#ffffff", "stop-pressed": "#b00f1d"}
MODES = pytest.mark.parametrize("colors", [{**LIGHT, **FIXED}, {**LIGHT, **DARK, **FIXED}], ids=["light", "dark"])


@pytest.mark.parametrize("page, scripts", [
    (PAGE, PADS), (PROGRAM, [*PROGRAMS, *(WWW / name for name in ("stops.js", "login.js", "link.js"))])],
    ids=["pad", "program"])
def test_each_element_that_a_script_uses_is_in_the_page(page, scripts):
    used = {name for script in scripts for name in re.findall(r'element\("([^"]+)"\)', script.read_text())}
    assert {name for name in used if f'id="{name}"' not in page} - {"name"} == set()


@pytest.mark.parametrize("page, names", [
    (PAGE, ["messages", "sentence", "notice", "task-text", "teacher-codes", "scores-table"]),
    (PROGRAM, ["sentence", "notice"])], ids=["pad", "program"])
def test_the_keyboard_reaches_each_text_that_scrolls(page, names):
    assert [name for name in names if not re.search(rf'id="{name}" class="scrolls"', page)] == []


def test_nothing_stands_inline_or_comes_from_another_host():
    for file in (*WWW.glob("*.html"), *SCRIPTS, *WWW.glob("*.css")):
        text = file.read_text().replace("http://www.w3.org/2000/svg", "")
        assert not re.search(r'https?://\w|<script(?![^>]*\bsrc=)|<style|\sstyle="|\son\w+="|url\(|data:', text), file


def test_text_from_outside_stays_text():
    for script in SCRIPTS:
        assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function",
                             script.read_text()), script


def parts(color):
    return [int(color[place:place + 2], 16) for place in (1, 3, 5)]


def luminance(color):
    """Return the relative luminance of "#rrggbb", as WCAG defines it."""
    shares = [part / 255 for part in parts(color)]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in shares]
    return sum(share * part for share, part in zip((0.2126, 0.7152, 0.0722), linear))


def contrast(one, other):
    """Return the contrast ratio of two colours "#rrggbb", as WCAG defines it."""
    dark, light = sorted(map(luminance, (one, other)))
    return (light + 0.05) / (dark + 0.05)


@MODES
@pytest.mark.parametrize("pairs, least", [(TEXTS, 4.5), (GRAPHICS, 3.0)], ids=["texts", "graphics"])
def test_colors_have_the_contrast_that_wcag_asks_for(colors, pairs, least):
    found = {(color, ground): contrast(colors[color], colors[ground])
             for color, grounds in pairs.items() for ground in grounds.split()}
    assert {pair: ratio for pair, ratio in found.items() if ratio < least} == {}


@MODES
def test_the_course_stands_out_from_the_map_that_is_seen_through_it(colors):
    opacity = float(re.search(r"course: .*opacity: ([\d.]+)", (WWW / "drawing.js").read_text())[1])
    mixed = [round(opacity * one + (1 - opacity) * other)
             for one, other in zip(parts(colors["course"]), parts(colors["ground"]))]
    assert contrast("#" + "".join(f"{part:02x}" for part in mixed), colors["ground"]) >= 3.0


def test_the_colors_of_all_texts_and_controls_and_their_grounds_are_among_those_that_are_compared():
    styles = "".join(file.read_text() for file in WWW.glob("*.css"))
    grounds = {each for grounds in TEXTS.values() for each in grounds.split()}
    dots = {"muted", "robot", "good", "warn", "bad"}  # and bars: what they show is written beside them
    assert set(re.findall(r"(?<!-)\bcolor: var\(--([\w-]+)\)", styles)) - TEXTS.keys() == set()
    assert set(re.findall(r"background: var\(--([\w-]+)\)", styles)) - dots - grounds == set()
    for control in r"button, select, input", r"a\[href\]":
        assert re.search(control + r" \{[^}]* border: 1px solid var\(--edge\)", styles), control


def test_each_warning_of_a_robots_health_has_a_line_for_the_teacher():
    lines = re.findall(r"^  (\w+): t\(", (WWW / "to_do.js").read_text(), re.M)
    assert sorted(lines) == sorted(FACTS)
