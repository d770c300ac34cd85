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
    (("--class", "7b", "add", "me@host", "board=sparkfun"), "Arguments are written as board:=sparkfun."),
    (("--class", "7b", "add", "me@host", "--name", "a", "bord:=x"), "Did you mean board:=x?"),
    (("--class", "7b", "add", "me@host", "cockpit_port:=x"), "ockpit_port:= is a number"),
    (("add", "me@host", "--nane", "a"), "unrecognized arguments: --nane"),
    (("hub", "board:=x"), "unrecognized arguments: board:=x"),
    (("fly",), "invalid choice: 'fly'"), (("log",), "required: NAME")])
def test_what_is_typed_wrong_gets_one_sentence(capsys, arguments, said):
    code, printed = typed(capsys, *arguments)
    assert code in (1, 2) and said in printed and printed.count("\n") == 1


@pytest.mark.parametrize("typed_words", [
    "--class 7b add me@host --name jetbot_07 board:=sparkfun cockpit_port:=81",
    "add --class 7b me@host board:=sparkfun --name jetbot_07 cockpit_port:=81",
    "add me@host --name jetbot_07 board:=sparkfun cockpit_port:=81 --class 7b"])
def test_what_a_robot_needs_and_the_class_may_be_typed_in_any_order(capsys, monkeypatch, typed_words):
    robots = []
    monkeypatch.setattr(commands, "checkout", lambda root: "c0ffee")
    monkeypatch.setattr(commands, "set_up", lambda fleet, entry, commit, arguments, listed: robots.append(
        (fleet.name, entry, arguments)))
    code, said = typed(capsys, *typed_words.split())
    assert code == 0, said
    assert robots == [("7b", Entry("jetbot_07", "host:81", "me@host"), ["board:=sparkfun", "cockpit_port:=81"])]


def added(monkeypatch, capsys, answers, *arguments):
    """Add a robot where these logins' robots answer; return what is printed, and the list."""
    monkeypatch.setattr(commands, "checkout", lambda root: "c0ffee")
    monkeypatch.setattr(commands, "set_up", lambda fleet, entry, commit, arguments, listed: listed())
    monkeypatch.setattr(commands, "ask", lambda fleet, entries, until: [
        Answer(each, problem="" if each.login in answers else "no answer") for each in entries])
    code, said = typed(capsys, "--class", "7b", "add", *arguments)
    return said, classes.open_class("7b", False).robots


@pytest.mark.parametrize("answers, listed", [
    (["me@a"], "me@a"), ([], "me@b"), (["me@a", "me@b"], "me@b")], ids=["another", "gone", "both ways"])
def test_a_name_that_a_robot_has_which_answers_goes_to_no_other(monkeypatch, capsys, answers, listed):
    added(monkeypatch, capsys, answers, "me@a", "--name", "jetbot_01")
    said, robots = added(monkeypatch, capsys, answers, "me@b", "--name", "jetbot_01")
    assert [each.login for each in robots] == [listed]
    assert ("jetbot_01 is the robot at a:8080, which answers" in said) == (listed == "me@a")


def test_a_robot_with_another_address_is_reached_there_by_ssh_too(monkeypatch, capsys):
    added(monkeypatch, capsys, [], "me@a", "--name", "jetbot_01")
    classes.open_class("7b", False).remember("jetbot_01", "10.0.0.7:8080")
    entry, = classes.open_class("7b", False).robots
    assert entry.ssh == "me@10.0.0.7" and commands.connected(classes.open_class("7b", False), entry).host == "10.0.0.7"
    assert table([Answer(entry, problem="", state=STATE, address="10.0.0.7:8080")]).split()[7] == "10.0.0.7:8080"
    typed(capsys, "add", "jetbot_01", "--address", "10.0.0.9:81")
    assert classes.open_class("7b", False).robots == [Entry("jetbot_01", "10.0.0.9:81", "me@10.0.0.9")]


def test_a_robot_that_is_named_again_is_listed_once(monkeypatch, capsys):
    added(monkeypatch, capsys, [], "me@a", "--name", "jetbot_04")
    assert [each.name for each in added(monkeypatch, capsys, [], "me@a", "--name", "jetbot_03")[1]] == ["jetbot_03"]


def test_the_key_of_a_removed_robot_is_void_also_when_another_gets_its_name(capsys):
    def key(name):
        return classes.open_class("7b", False).key_of(name)
    for name in "jetbot_07", "jetbot_08":
        typed(capsys, "--class", "7b", "add", name, "--address", "10.0.0.7")
    stolen, other = key("jetbot_07"), key("jetbot_08")
    assert "its key is void" in typed(capsys, "remove", "jetbot_07")[1]
    assert key("jetbot_07") != stolen
    typed(capsys, "add", "jetbot_07", "--address", "10.0.0.9")
    assert key("jetbot_07") != stolen and key("jetbot_08") == other


@pytest.mark.parametrize("runs, opened, started", [
    (True, ["http://localhost:81/?codes"], []), (False, [], [(81, "--open", "?codes")])])
def test_the_cards_open_on_the_hub_that_runs_or_on_a_new_one(monkeypatch, capsys, runs, opened, started):
    pages, hubs = [], []
    monkeypatch.setattr(commands, "is_free", lambda port: not runs)
    monkeypatch.setattr(commands, "open_browser", pages.append)
    monkeypatch.setattr(commands, "hub", lambda fleet, given, *opened: hubs.append((given.port, *opened)))
    typed(capsys, "--class", "7b", "key", "jetbot_07")
    assert "http://localhost:81/?codes, then Print on paper" in typed(capsys, "cards", "--port", "81")[1]
    assert (pages, hubs) == (opened, started)


@pytest.mark.parametrize("terminal, answer, deleted", [
    (True, "7b", True), (True, "", False), (True, "7a", False), (False, "7b", False)])
def test_a_class_is_forgotten_once_its_name_is_typed(monkeypatch, capsys, terminal, answer, deleted):
    typed(capsys, "--class", "7b", "key", "jetbot_07")
    monkeypatch.setattr(commands.sys.stdin, "isatty", lambda: terminal, raising=False)
    monkeypatch.setattr("builtins.input", lambda question: answer)
    code, said = typed(capsys, "forget")
    assert (code == 0) == deleted == (classes.classes(classes.FOLDER) == []) == ("Deleted" in said)


def test_two_classes_are_named_where_one_is_missing(capsys):
    typed(capsys, "--class", "7b", "key", "jetbot_07")
    typed(capsys, "--class", "8a", "key", "jetbot_07")
    assert "this computer has 7b and 8a" in typed(capsys)[1]


def test_a_robot_without_ssh_is_not_updated_and_forgets_nothing(capsys):
    typed(capsys, "--class", "7b", "add", "jetbot_07", "--address", "127.0.0.1:1")
    code, said = typed(capsys, "forget", "--yes")
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
