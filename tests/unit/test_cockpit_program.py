"""The page for programs: Blockly and CodeMirror are those that npm has, and the scripts around them."""

import hashlib
import re

import pytest
from cockpit_control import ADA, BOB, STOPPED

from conftest import ROOT
from jetbot_cockpit.session.protocol import Message

read_files = pytest.importorskip("jetbot_cockpit.web.page_files").read_files  # it needs Tornado
pytest_plugins = ["cockpit_control"]  # its fixtures

COCKPIT = ROOT / "morbot_ws/src/jetbot_cockpit"


def fetched(name):
    """Return the versions and the checksums of what npm has, and the list of it in the script that fetches it."""
    folder, script = COCKPIT / "www/vendor" / name, (COCKPIT / f"fetch_{name}").read_text()
    lines = (folder / "SHA256SUMS").read_text().splitlines()
    versions = dict(line[2:].split(" ") for line in lines if line.startswith("# "))
    sums = {name: digest for digest, name in (line.split("  ") for line in lines if not line.startswith("# "))}
    files = {file.relative_to(folder).as_posix(): file for file in folder.rglob("*")
             if file.is_file() and file.suffix != ".br"}
    assert sums == {name: hashlib.sha256(file.read_bytes()).hexdigest() for name, file in files.items()
                    if name != "SHA256SUMS"}, "nothing else is there"
    return versions, set(sums), set(re.search(r'(?:files|packages)="(.*?)"', script, re.DOTALL)[1].split())


def test_blockly_is_as_its_checksums_say_and_nothing_else_is_there():
    versions, names, listed = fetched("blockly")
    assert re.fullmatch(r"13\.\d+\.\d+", versions["blockly"]) and len(versions) == 1
    assert names == listed


def test_codemirror_is_bundled_of_packages_with_their_versions_and_as_its_checksums_say():
    versions, names, listed = fetched("codemirror")
    assert versions["@codemirror/state"].startswith("6.") and set(versions) == listed
    assert names == {"LICENSE", "codemirror.js"}


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
        "type": "program", "robot": "/red", "ready": True, "pose": [1, 2, 3], "speed": None, "line": None,
        "command": None, "wheels": [0, 0]}
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
