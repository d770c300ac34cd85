"""What ./morbot fleet prints, without a robot."""

import stat

import pytest

from jetbot_class.fleet import classes, commands
from jetbot_class.fleet.asking import Answer
from jetbot_class.fleet.ssh import Ssh
from jetbot_class.fleet.table import table
from jetbot_cockpit.remote.fleet import Entry
from jetbot_cockpit.remote.key import read_key

STATE = {"status": "stopped: zero", "answers": True, "driver": None, "program": "", "state": "stopped"}
HEALTH = [{"code": "battery", "template": "", "arguments": {"volts": "11.9", "percent": "62"}, "level": "ok"}]


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("HOME", str(tmp_path))
    return tmp_path


def typed(capsys, *arguments):
    """Type a command; return its exit code, and all that it prints."""
    try:
        code = commands.main(list(arguments))
    except SystemExit as ended:
        code = ended.code
    printed = capsys.readouterr()
    return code, printed.out + printed.err


def test_a_robot_is_listed_by_hand_with_a_key_to_type(capsys, home):
    assert typed(capsys, "--class", "7b", "add", "jetbot_07", "--address", "10.0.0.7")[0] == 0
    code, said = typed(capsys, "key", "jetbot_07")
    name, key = said.split()
    assert name == "jetbot_07" and read_key(key)
    assert typed(capsys, "key") == (0, said)
    assert stat.S_IMODE((home / ".ros/morbot_classes/7b/fleet.json").stat().st_mode) == 0o600
    typed(capsys, "add", "jetbot_07", "--address", "10.0.0.8:81")  # DHCP gave another one
    assert classes.open_class("7b", False).robots == [Entry("jetbot_07", "10.0.0.8:81")]


def test_the_table_says_how_each_robot_is_or_why_it_is_missing():
    entry = Entry("jetbot_07", "10.0.0.7")
    lines = table([Answer(entry, "c0ffee" * 6 + "c0ff", 0.0123, {**STATE, "health": HEALTH}, problem=""),
                   Answer(entry, problem="No connection to 10.0.0.7:8080.")]).splitlines()
    assert lines[1].split("  ") == ["jetbot_07", "10.0.0.7", "c0ffeec0", "11.9 V, 62 %", "12 ms", "stopped: zero"]
    assert lines[2].endswith("No connection to 10.0.0.7:8080.")


def test_a_robot_that_does_not_answer_is_named_and_the_exit_code_says_so(capsys):
    typed(capsys, "--class", "7b", "add", "jetbot_07", "--address", "127.0.0.1:1")
    code, said = typed(capsys)
    assert code == 1 and said.count("No connection to 127.0.0.1:1.") == 1


@pytest.mark.parametrize("arguments, said", [
    ((), "The class is missing; this computer has none yet"),
    (("--class", "../x", "key", "a"), "No class can be called ../x"),
    (("--class", "7b"), "There is no class 7b on this computer"),
    (("--class", "7b", "add", "jetbot-07", "--address", "10.0.0.7"), "No robot can be called jetbot-07"),
    (("--class", "7b", "add", "jetbot_07", "--address", "http://x/"), "http://x/ is not an address"),
    (("--class", "7b", "add", "--", "-oProxyCommand=x"), "-oProxyCommand=x is not a computer"),
    (("--class", "7b", "add", "me@host", "--name", "7"), "No robot can be called 7"),
    (("fly",), "invalid choice: 'fly'"), (("log",), "required: NAME")])
def test_what_is_typed_wrong_gets_one_sentence(capsys, arguments, said):
    code, printed = typed(capsys, *arguments)
    assert code in (1, 2) and said in printed and printed.count("\n") == 1


def test_two_classes_are_named_where_one_is_missing(capsys):
    typed(capsys, "--class", "7b", "key", "jetbot_07")
    typed(capsys, "--class", "8a", "key", "jetbot_07")
    assert "this computer has 7b and 8a" in typed(capsys)[1]


def test_a_robot_without_ssh_is_not_updated_and_forgets_nothing(capsys):
    typed(capsys, "--class", "7b", "add", "jetbot_07", "--address", "127.0.0.1:1")
    code, said = typed(capsys, "forget")
    assert code == 1 and "still on jetbot_07" in said
    assert classes.open_class("7b", False).robots


@pytest.mark.parametrize("said, sentence", [
    ("ssh: connect to host a port 22: Connection refused", "a has no ssh running"),
    ("ssh: Could not resolve hostname a: Name or service not known", "no computer is called a in this network"),
    ("me@a: Permission denied (publickey,password).", "a refuses the login: is it me@a?"),
    ("ssh: connect to host a port 22: Connection timed out", "a does not answer"),
    ("@ WARNING: REMOTE HOST IDENTIFICATION HAS CHANGED! @\nHost key verification failed.", "a has another host key"),
    ("something\nnew \x1b[2J", "a: new \\x1b[2J")])
def test_what_ssh_says_becomes_a_sentence(tmp_path, said, sentence):
    assert Ssh("me@a", tmp_path)._cause(said).startswith(sentence)
