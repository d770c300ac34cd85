"""How people get to the page: the codes that the cockpit prints, QR codes, and the browser of this desktop."""

import os
import signal
import subprocess
import sys

import pytest

from conftest import PYTHONPATH
from jetbot.wait import wait_until
from jetbot_cockpit_server.web.access import make_grants
from jetbot_cockpit_server.web.handout import PROGRAMS, Card, open_browser

URL = "http://localhost:8080/"
BROWSER = """#!/bin/sh
echo a browser prints; echo and complains >&2
read line && echo "it reads $line" >{folder}/read
ps -o ppid= -o sid= -o pid= $$ >{folder}/ids
echo "$0 $@" >>{folder}/opened
sleep 60
"""
OPEN = f"import sys; from jetbot_cockpit_server.web.handout import open_browser; open_browser({URL!r}); print('done')"


@pytest.fixture
def cards():
    return [Card(grant, "192.168.100.200", 8080) for grant in make_grants(3)]


def test_each_code_stands_behind_its_label_in_an_address_that_can_be_opened(cards):
    for card, label in zip(cards, ("teacher", "jetbot_01", "jetbot_02", "jetbot_03")):
        assert card.text(colors=False).splitlines()[:2] == [
            f"{label}:", f"http://192.168.100.200:8080/#{card.grant.code}"]


def test_a_qr_code_is_a_square_on_the_page_and_fits_into_a_terminal(cards):
    pytest.importorskip("segno")
    rows = cards[0].message()["rows"]
    assert {len(row) for row in rows} == {len(rows)} and set("".join(rows)) == {"0", "1"}
    lines = cards[0].text(colors=False).splitlines()[2:]
    assert {len(line) for line in lines} == {len(rows)} and len(lines) < 24
    assert {line[0] for line in cards[0].text(colors=True).splitlines()[2:]} == {"\x1b"}


def test_without_segno_there_are_addresses_only(monkeypatch):
    monkeypatch.setitem(sys.modules, "segno", None)
    card = Card(make_grants(0)[1], "localhost", 8080)
    assert card.message()["rows"] == [] and len(card.text(colors=False).splitlines()) == 2


def test_the_page_gets_all_but_the_cookie(cards):
    assert set(cards[0].message()) == {"label", "role", "robot", "url", "code", "rows"}


@pytest.fixture
def desktop(tmp_path):
    """The environment of a desktop, with stand-ins for the programs that open a page."""
    for name in PROGRAMS:
        (tmp_path / name).write_text(BROWSER.format(folder=tmp_path))
        (tmp_path / name).chmod(0o755)
    yield {"PATH": f"{tmp_path}:/usr/bin:/bin", "DISPLAY": ":0", "PYTHONPATH": PYTHONPATH}
    for session in ids(tmp_path)[1:2]:
        os.killpg(session, signal.SIGKILL)


def ids(folder):
    """Return the parent, the session and the process of the browser that was opened; [] without one."""
    file = folder / "ids"
    return [int(word) for word in file.read_text().split()] if file.exists() else []


def opened(folder):
    return (folder / "opened").read_text().splitlines() if (folder / "opened").exists() else []


@pytest.mark.parametrize("display", ["DISPLAY", "WAYLAND_DISPLAY"])
def test_the_page_opens_once_where_there_is_a_desktop(desktop, tmp_path, display):
    desktop.pop("DISPLAY")
    assert open_browser(URL, {**desktop, display: "0"})
    assert wait_until(lambda: opened(tmp_path), 10)
    assert opened(tmp_path) == [f"{tmp_path}/xdg-open {URL}"]


@pytest.mark.parametrize("change", [{"DISPLAY": ""}, {"SSH_CONNECTION": "10.0.0.2 5 10.0.0.1 22"}, {"PATH": "/none"}],
                         ids=str)
def test_without_a_desktop_or_a_browser_nothing_opens(desktop, tmp_path, change):
    assert not open_browser(URL, {**desktop, **change})
    assert not opened(tmp_path)


def test_the_browser_is_silent_and_outlives_the_program_that_opened_it(desktop, tmp_path):
    run = subprocess.run([sys.executable, "-c", OPEN], env=desktop, input="secret\n", text=True, timeout=30,
                         stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True)
    assert run.stdout == "done\n"
    assert wait_until(lambda: opened(tmp_path), 10)
    parent, session, process = ids(tmp_path)
    assert session != os.getsid(0) and parent not in (os.getpid(), session)
    assert not (tmp_path / "read").exists()
    os.kill(process, 0)
