"""Whatever a robot, a class, a program or a person is called: it is so everywhere, or refused in one sentence."""

import json
import re
import unicodedata

import pytest
from cockpit_control import ADA, TEACHER, Cockpit, Kept
from hypothesis import HealthCheck, example, given, settings
from hypothesis import strategies as st

from jetbot import JetbotError
from jetbot_class.fleet import commands
from jetbot_class.robot.words import check_names
from jetbot_cockpit.classroom.folder import ClassFolder
from jetbot_cockpit.classroom.programs import Programs
from jetbot_cockpit.remote import identity
from jetbot_cockpit.remote.key import new_key
from jetbot_cockpit.session import protocol
from jetbot_cockpit.session.messages import REQUESTS

PIECES = [
    "jetbot_07", "ö", "日本", "👩\u200d👩\u200d👧", "e\u0301", "'", '"', "`id`", "$HOME", "\\", "&amp;", "{0}", "%s",
    "<img src=x onerror=alert(1)>", "/", "..", "-", "--help", "=", ":=", " ", "\t", "\n", "\0", "\x1b[2J", "\x7f",
    "\u202e", "\u2066", "\u2028", "\ud800", "x" * 40, "日" * 400]
anything = st.lists(st.sampled_from(PIECES) | st.characters(), max_size=4).map("".join)
EXAMPLES = [example(name=name) for name in ["", *PIECES]]


def for_any_name(test):
    """Run a test for each of PIECES, for nothing, and for random joins of them."""
    for each in EXAMPLES:
        test = each(test)
    return settings(max_examples=60, deadline=None, database=None,
                    suppress_health_check=[HealthCheck.function_scoped_fixture])(given(name=anything)(test))


def is_harmful(text):
    """Return whether something in it ends a line, moves the cursor, reverses what is around it, or is no character."""
    return any(unicodedata.category(each) in ("Cc", "Cs", "Zl", "Zp") or unicodedata.bidirectional(each) in (
        "LRE", "RLE", "LRO", "RLO", "PDF", "LRI", "RLI", "FSI", "PDI") for each in text)


def is_sentence(said):
    """Return whether a terminal shows these lines as they are meant."""
    return said.strip() and not is_harmful(said.replace("\n", " "))


def parsed(name, **fields):
    """Return what a page asks for with this name, or None if that is refused, as it must be for some names."""
    is_name = len(name) <= 20 and not is_harmful(name)
    try:
        message = protocol.parse(json.dumps({**fields, "name": name}))
        assert is_name
        return message
    except protocol.ProtocolError:
        assert not is_name
        return None


@for_any_name
def test_a_person_is_called_as_typed_or_the_page_is_refused(name):
    cockpit, message = Cockpit(folder=Kept()), parsed(name, type="name")
    if not message:
        return
    cockpit.do(ADA, message)
    cockpit.push(ADA)
    called = name.strip()
    assert cockpit.driver()["name"] == (called or "pupil 1")
    assert cockpit.robots.reports[-1][:2] == ("/red", called)
    assert json.dumps(cockpit.control.state(), ensure_ascii=False).encode(), "each page can be sent it"


@for_any_name
def test_a_pupil_is_kept_as_a_teacher_calls_it_or_the_page_is_refused(name):
    kept = Kept()
    cockpit = Cockpit(folder=kept)
    message = parsed(name, type="pupil", robot="/blue")
    if not message:
        return
    cockpit.do(TEACHER, message)
    cockpit.settle()
    again = Cockpit(folder=kept).control.robots()
    assert {row["id"]: row["pupil"] for row in again} == {"/red": "", "/blue": name.strip()}


@for_any_name
def test_a_program_is_kept_under_its_name_or_refused_and_its_file_has_a_number(tmp_path, name):
    is_name = name.strip() != "" and len(name) <= 40 and not is_harmful(name)
    assert REQUESTS["save"].fields["name"].accepts(name) == is_name
    if not is_name:
        return
    folder = ClassFolder(str(tmp_path), "7b")
    try:
        programs = Programs(folder)
        version = next((row["version"] for row in programs.rows("/red")), 0)
        programs.save("/red", "0" * 16, version, name, "{}")
        assert Programs(folder).open("/red", "0" * 16).name == name
    finally:
        folder.close()
    assert {file.name for file in (tmp_path / "7b").iterdir()} == {f"program_{'0' * 16}.json"}


@for_any_name
def test_a_robot_and_a_class_have_plain_names_and_all_others_are_refused_in_a_sentence(tmp_path, name):
    for robot, class_name, pattern in (name, "7b", r"[A-Za-z]\w{0,29}"), ("jetbot_07", name, r"[\w-]{1,20}"):
        is_plain = bool(re.fullmatch(pattern, name, re.ASCII))
        try:
            check_names(robot, class_name)
            assert is_plain
        except JetbotError as refused:
            assert not is_plain and is_sentence(str(refused))
        if is_plain:
            mine = identity.Identity(robot, class_name, new_key())
            identity.write(mine, str(tmp_path / "identity.json"))
            assert identity.read(str(tmp_path / "identity.json")) == mine


@pytest.mark.parametrize("words", [("--class={}", "add", "--address=10.0.0.7", "jetbot_07"),
                                   ("--class=7b", "add", "--address=10.0.0.7", "--", "{}")], ids=["class", "robot"])
@for_any_name
def test_a_class_on_the_teachers_computer_stays_in_its_folder(tmp_path, monkeypatch, capsys, words, name):
    monkeypatch.setenv("HOME", str(tmp_path / "home"))
    try:
        code = commands.main([name if word == "{}" else word.replace("{}", name) for word in words])
    except SystemExit as ended:
        code = ended.code
    printed = capsys.readouterr()
    assert is_sentence(printed.out + printed.err)
    files = {str(path.relative_to(tmp_path)) for path in tmp_path.rglob("fleet.json")}
    class_name = words[0].partition("=")[2].replace("{}", name) or "7b"
    assert code or f"home/.ros/morbot_classes/{class_name}/fleet.json" in files
    assert all(re.fullmatch(r"home/\.ros/morbot_classes/[\w-]{1,20}/fleet\.json", file, re.ASCII) for file in files)
