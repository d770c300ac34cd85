"""The cockpit's page is complete, and needs nothing that its Content-Security-Policy forbids."""

import re

import pytest

from conftest import ROOT

PAGES = pytest.importorskip("jetbot_cockpit.web.handlers").PAGES  # it needs Tornado
WWW = ROOT / "morbot_ws/src/jetbot_cockpit/www"
PAGE, PROGRAM = ((WWW / name).read_text() for name in ("index.html", "program.html"))
PADS, PROGRAMS = (sorted(WWW.glob(names)) for names in ("*.js", "program/*.js"))
SCRIPTS = PADS + PROGRAMS
LIGHT, DARK = (dict(re.findall(r"--([\w-]+): (#\w{6})", block))
               for block in re.findall(r":root \{(.*?)\}", (WWW / "style.css").read_text(), re.S))
TEXTS = {"text": "ground surface calm-ground", "muted": "ground surface calm-ground", "accent": "ground surface",
         "good": "surface good-ground", "warn": "surface warn-ground", "bad": "surface bad-ground"}


@pytest.mark.parametrize("name", ["pad", "speed", "stop", "release", "status", "robot", "map", "camera", "wheels"])
def test_the_page_has_its_binding_ids(name):
    assert PAGE.count(f'id="{name}"') == 1


@pytest.mark.parametrize("page, scripts", [
    (PAGE, PADS), (PROGRAM, [*PROGRAMS, *(WWW / name for name in ("stops.js", "login.js", "link.js"))])],
    ids=["pad", "program"])
def test_each_element_that_a_script_uses_is_in_the_page(page, scripts):
    used = {name for script in scripts for name in re.findall(r'element\("([^"]+)"\)', script.read_text())}
    assert {name for name in used if f'id="{name}"' not in page} - {"name"} == set()


def test_each_file_that_is_loaded_exists():
    loaded = {WWW / PAGES.get(name.strip("/"), name) for name in re.findall(r'(?:src|href)="([^"]+)"', PAGE + PROGRAM)}
    imported = {script.parent / name for script in SCRIPTS
                for name in re.findall(r'^(?!.*@import).*from "(\.[^"]+)"', script.read_text(), re.M)}
    assert {file for file in loaded | imported if not file.is_file()} == set()


def test_nothing_stands_inline_or_comes_from_another_host():
    for file in (*WWW.glob("*.html"), *SCRIPTS, *WWW.glob("*.css")):
        text = file.read_text().replace("http://www.w3.org/2000/svg", "")
        assert not re.search(r'https?://\w|<script(?![^>]*\bsrc=)|<style|\sstyle="|\son\w+="|url\(|data:', text), file


def test_text_from_outside_stays_text():
    for script in SCRIPTS:
        assert not re.search(r"innerHTML|outerHTML|insertAdjacentHTML|document\.write|\beval\(|new Function",
                             script.read_text()), script


def luminance(color):
    """Return the relative luminance of "#rrggbb", as WCAG defines it."""
    parts = [int(color[place:place + 2], 16) / 255 for place in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.03928 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return sum(share * part for share, part in zip((0.2126, 0.7152, 0.0722), linear))


@pytest.mark.parametrize("colors", [LIGHT, {**LIGHT, **DARK}], ids=["light", "dark"])
@pytest.mark.parametrize("text", TEXTS)
def test_texts_have_the_contrast_that_wcag_asks_for(colors, text):
    for ground in TEXTS[text].split():
        dark, light = sorted(map(luminance, (colors[text], colors[ground])))
        assert (light + 0.05) / (dark + 0.05) >= 4.5, ground
