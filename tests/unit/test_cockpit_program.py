"""The page for programs: Blockly is the one that npm has, and the scripts around it."""

import hashlib
import re

import pytest
from cockpit_control import ADA, BOB, STOPPED

from conftest import ROOT
from jetbot_cockpit.session.protocol import Message

read_files = pytest.importorskip("jetbot_cockpit.web.page_files").read_files  # it needs Tornado
pytest_plugins = ["cockpit_control"]  # its fixtures

BLOCKLY = ROOT / "morbot_ws/src/jetbot_cockpit/www/vendor/blockly"
FETCH = (ROOT / "morbot_ws/src/jetbot_cockpit/fetch_blockly").read_text()


def test_blockly_is_as_its_checksums_say_and_nothing_else_is_there():
    version, *lines = (BLOCKLY / "SHA256SUMS").read_text().splitlines()
    assert re.fullmatch(r"# blockly 13\.\d+\.\d+", version)
    sums = {name: digest for digest, name in (line.split("  ") for line in lines)}
    files = {file.relative_to(BLOCKLY).as_posix(): file for file in BLOCKLY.rglob("*")
             if file.is_file() and file.suffix != ".br"}
    assert sums == {name: hashlib.sha256(file.read_bytes()).hexdigest() for name, file in files.items()
                    if name != "SHA256SUMS"}
    assert set(sums) == set(re.search(r'files="(.*?)"', FETCH, re.DOTALL)[1].split())


def test_the_pad_loads_nothing_of_it():
    index = read_files()["index.html"].plain.decode()
    assert "vendor" not in index and "program/" not in index
    loaded = re.findall(r'from "\./([^"]+)"', "".join(
        file.plain.decode() for name, file in read_files().items() if re.fullmatch(r"\w+\.js", name)))
    assert not [name for name in loaded if "/" in name]


@pytest.fixture
def running(cockpit):
    """A program of Ada's page runs, and stands."""
    assert cockpit.do(ADA, Message("program", "/red"))["type"] == "program"
    return cockpit


def test_a_program_gets_its_robot_and_what_that_senses(cockpit):
    assert cockpit.do(ADA, Message("program", "/red")) == {
        "type": "program", "robot": "/red", "ready": True, "pose": [1, 2, 3], "line": None, "wheels": [0, 0]}
    assert cockpit.driver()["id"] == ADA.id
    assert cockpit.drives() == STOPPED


def test_nobody_else_drives_the_robot_of_a_program_that_stands(running):
    for _ in range(20):
        running.wait(0.5)
        running.do(ADA, Message("program", "/red"))
    assert running.push(BOB)["type"] == "lift"
    running.lift(BOB)
    running.wait(5.1)
    assert running.push(BOB) is None, "its page is gone"


def test_a_program_alone_does_not_keep_the_robot_driving(driven):
    for _ in range(10):
        driven.wait(0.05)
        driven.do(ADA, Message("program", "/red"))
    assert driven.push(ADA)["type"] == "lift", "its switch has fired"
    assert driven.drives() == STOPPED


def test_a_program_is_refused_where_a_command_is(cockpit, driven):
    assert cockpit.do(BOB, Message("program", "/red"))["type"] == "lift"
    cockpit.robots.set_emergency_stop(None, True)
    cockpit.wait(0.1)
    assert cockpit.do(BOB, Message("program", "/blue"))["type"] == "lift"
