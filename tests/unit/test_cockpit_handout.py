"""How people get to the page: the codes that the cockpit prints, QR codes, and the browser of this desktop."""

import os
import signal
import subprocess
import sys

import pytest

from conftest import PYTHONPATH
from jetbot.wait import wait_until
from jetbot_cockpit.web.access import make_grants, numbered
from jetbot_cockpit.web.handout import Card, open_browser

URL = "http://localhost:8080/"
BROWSER = """#!/bin/sh
echo a browser prints; echo and complains >&2
read line
echo $(ps -o ppid= -o sid= -o pid= $$) "$@" $line >{folder}/opened
sleep 60
"""
OPEN = f"""import os; from jetbot_cockpit.web.handout import open_browser
open_browser({URL!r}); print(os.getsid(0))"""


@pytest.fixture
def cards():
    return [Card(grant, "192.168.100.200", 8080) for grant in make_grants(numbered(3))]


def test_each_code_stands_behind_its_label_in_an_address_that_can_be_opened(cards):
    for card, label in zip(cards, ("teacher", "jetbot_01", "jetbot_02", "jetbot_03")):
        assert card.text(colors=False).splitlines()[:2] == [
            f"{label}:", f"http://192.168.100.200:8080/#{card.grant.code}"]


def test_a_qr_code_is_a_square_on_the_page_and_fits_into_a_terminal(cards):
    pytest.importorskip("segno")
    assert set(cards[0].message()) == {"label", "role", "robot", "url", "code", "rows"}, "and no cookie"
    rows = cards[0].message()["rows"]
    assert {len(row) for row in rows} == {len(rows)} and set("".join(rows)) == {"0", "1"}
    lines = cards[0].text(colors=False).splitlines()[2:]
    assert {len(line) for line in lines} == {len(rows)} and len(lines) < 24
    assert {line[0] for line in cards[0].text(colors=True).splitlines()[2:]} == {"\x1b"}


def test_without_segno_there_are_addresses_only(monkeypatch):
    monkeypatch.setitem(sys.modules, "segno", None)
    card = Card(make_grants(numbered(0))[1], "localhost", 8080)
    assert card.message()["rows"] == [] and len(card.text(colors=False).splitlines()) == 2


@pytest.fixture
def desktop(tmp_path):
    """The environment of a desktop, with a stand-in for the program that opens a page."""
    browser = tmp_path / "xdg-open"
    browser.write_text(BROWSER.format(folder=tmp_path))
    browser.chmod(0o755)
    return {"PATH": f"{tmp_path}:/usr/bin:/bin", "DISPLAY": ":0", "PYTHONPATH": PYTHONPATH}


@pytest.mark.parametrize("change", [{"DISPLAY": ""}, {"SSH_CONNECTION": "10.0.0.2 5 10.0.0.1 22"}, {"PATH": "/none"}],
                         ids=str)
def test_without_a_desktop_or_a_browser_nothing_opens(desktop, change):
    assert not open_browser(URL, {**desktop, **change})


@pytest.mark.parametrize("display", ["DISPLAY", "WAYLAND_DISPLAY"])
def test_the_browser_is_silent_and_outlives_the_program_that_opened_it(desktop, tmp_path, display):
    desktop.pop("DISPLAY")
    run = subprocess.run([sys.executable, "-c", OPEN], env={**desktop, display: "0"}, input="secret\n", text=True,
                         timeout=30, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    file = tmp_path / "opened"
    assert wait_until(lambda: file.exists() and file.read_text().endswith("\n"), 10)
    parent, session, process, *arguments = file.read_text().split()
    assert arguments == [URL], "it reads nothing, and opens the page"
    assert run.stdout == f"{int(run.stdout)}\n" and run.stdout.strip() not in (session, parent)
    os.kill(int(process), 0)
    os.killpg(int(session), signal.SIGKILL)
