"""./morbot robot: one command makes a computer a robot of a class, changes it, and undoes all; also after a kill."""

import fcntl
import os
import shutil
import xml.etree.ElementTree as ET

import pytest
from robot_computer import KEY, RobotComputer

from conftest import ROOT

pytestmark = pytest.mark.shell
NAMED = "jetbot_07", "--class", "7b"
DROP_IN = "etc/systemd/system/jetbot.service.d/morbot.conf"
AVAHI = "etc/avahi/services/morbot.service"
GROUPED = " ".join(KEY[at:at + 4] for at in range(0, len(KEY), 4)).lower()


@pytest.fixture
def computer(tmp_path):
    """A computer that is no robot yet."""
    return RobotComputer(tmp_path)


@pytest.fixture
def named(computer):
    """One that is jetbot_07 of the class 7b."""
    code, printed = computer.robot(*NAMED, "camera:=false", stdin=KEY)
    assert code == 0, printed
    return computer


def last_command(computer):
    return computer.read(DROP_IN).splitlines()[-1].split("robot.launch ")[1]


def test_a_robot_is_built_named_announced_and_started(named):
    assert named.identity() == {"robot": "jetbot_07", "class_name": "7b", "key": KEY}
    assert (named.home / ".ros/morbot_robot.json").stat().st_mode & 0o777 == 0o600
    assert last_command(named) == '"robot:=jetbot_07" "camera:=false"'
    assert named.runs() == str(named.folder / "MorBot")
    assert named.read("etc/hostname") == "jetbot-07\n"
    assert named.read("etc/hosts") == "127.0.0.1 localhost\n127.0.1.1 jetbot-07 nano.school\n"
    service = ET.fromstring(named.read(AVAHI)).find("service")
    assert [each.text for each in service] == ["_morbot._tcp", "8080", "name=jetbot_07", "class=7b"]
    calls = named.calls()
    assert calls[:2] == ["morbot install", "morbot setup"]
    assert "usermod -aG video kim" in calls, "it is in i2c, and there is no dialout"
    assert "systemctl try-restart avahi-daemon" in calls, "it is announced by its new name"
    assert calls[-3:] == ["systemctl enable --quiet jetbot-guard.service jetbot.service",
                          "systemctl restart jetbot-guard.service jetbot.service", "morbot doctor"]


def test_the_units_are_for_this_user_and_the_folder_that_current_leads_to(named):
    for unit in "jetbot.service", "jetbot-guard.service", "jetbot.service.d/morbot.conf":
        text = named.read(f"etc/systemd/system/{unit}")
        assert "/home/jetbot/" not in text
        assert "User=kim\n" in text or unit.endswith(".conf")
        assert f"{named.home}/.local/share/morbot/current/morbot_ws/devel/env.sh" in text
    for unit in "jetbot", "jetbot-guard":  # the guard, too, writes to a fake bus
        assert f"ReadWritePaths=-{named.home}/.ros\n" in named.read(f"etc/systemd/system/{unit}.service")


def test_at_the_end_it_says_what_to_test_on_a_box_and_what_the_doctor_found(computer):
    code, printed = computer.robot(*NAMED, "i2c_bus:=7", "camera:=false", stdin=KEY)
    assert code == 0
    assert computer.calls()[-1] == "morbot doctor i2c_bus:=7"
    assert "1. Open http://jetbot-07.local:8080 or http://192.168.1.17:8080" in printed
    assert printed.endswith("The doctor found a fault, see above: correct it first.\n")


def test_arguments_are_kept_changed_and_taken_back(named):
    named.robot("board:=sparkfun", "camera_source:=command:a \"$b\" 100%", stdin="")
    assert last_command(named) == ('"robot:=jetbot_07" "camera:=false" "board:=sparkfun" '
                                   '"camera_source:=command:a \\"$$b\\" 100%%"')
    named.robot("camera:=", "camera_source:=", "cockpit_port:=8081", stdin="")
    assert last_command(named) == '"robot:=jetbot_07" "board:=sparkfun" "cockpit_port:=8081"'
    assert "<port>8081</port>" in named.read(AVAHI)


def test_another_name_needs_its_own_key(named):
    code, printed = named.robot("red", stdin="")
    assert (code, printed) == (1, "The key of red is missing. On the teacher's computer: ./morbot fleet key red\n")
    assert named.identity()["robot"] == "jetbot_07"
    assert named.robot("red", stdin=KEY[::-1])[0] == 0
    assert named.identity() == {"robot": "red", "class_name": "7b", "key": KEY[::-1]}
    assert named.read("etc/hosts") == "127.0.0.1 localhost\n127.0.1.1 red nano.school\n"


def test_a_key_is_typed_in_groups_until_it_can_be_one(computer):
    code, printed = computer.robot(*NAMED, stdin=f"{KEY[:-1]}\n{GROUPED}\n", terminal=True)
    assert code == 0
    assert printed.count("Key of jetbot_07 (on the teacher's computer: ./morbot fleet key jetbot_07): ") == 2
    assert "That is no key: 26 letters and digits" in printed
    assert computer.identity()["key"] == KEY


def test_the_same_robot_is_not_asked_for_its_key_again(named):
    code, printed = named.robot(*NAMED, terminal=True)
    assert code == 0 and "Key of" not in printed
    assert named.identity()["key"] == KEY
    (named.folder / "key").write_text(KEY[::-1])
    assert named.robot("--key-file", f"{named.folder}/key", terminal=True)[0] == 0
    assert named.identity()["key"] == KEY[::-1]


def test_typed_in_another_folder_that_one_runs(named):
    named.checkout("new")
    named.robot(*NAMED, stdin=KEY, FOLDER="new")
    assert named.runs() == str(named.folder / "new")


def test_the_units_of_another_version_are_written_without_a_restart(named):
    named.checkout("new")
    (named.folder / "new/systemd").unlink()
    shutil.copytree(ROOT / "systemd", named.folder / "new/systemd")
    with (named.folder / "new/systemd/jetbot.service").open("a") as unit:
        unit.write("# newer\n")
    before = last_command(named)
    assert named.robot("--files", FOLDER="new") == (0, "")
    assert named.read("etc/systemd/system/jetbot.service").endswith("# newer\n") and last_command(named) == before
    assert [call for call in named.calls() if call.startswith("systemctl")] == ["systemctl daemon-reload"]
    assert named.robot("--files", FOLDER="new") == (0, "") and not named.calls()
    assert named.robot("--files")[0] == 0 and "newer" not in named.read("etc/systemd/system/jetbot.service")


@pytest.mark.parametrize("words, sentence", [
    (["7", "--class", "7b"], "7 is no name of a robot. It has letters, digits and _, 30 at most, and begins with a "
                             "letter, such as jetbot_07."),
    (["jetbot_07"], "The class of jetbot_07 is missing. Such as: ./morbot robot jetbot_07 --class 7b"),
    (["jetbot_07", "--class", "7 b"], "7 b is no name of a class, which has letters, digits, _ and -, 20 at most."),
    (["a", "b", "--class", "7b"], "A robot has one name. Such as: ./morbot robot jetbot_07 --class 7b"),
    ([*NAMED, "bord:=sparkfun"], "There is no argument bord of a robot. Did you mean board:=sparkfun?"),
    ([*NAMED, "lan:=false"], "There is no argument lan of a robot."),
    ([*NAMED, "config:=none.yaml"], "There is no file none.yaml."),
    ([*NAMED, "cockpit_port:=x"], "Cockpit_port:= is a number from 1 to 65535, and not x."),
    ([*NAMED, "--of"], "Unrecognized arguments: --of."),
    (["--forget"], "--forget goes with --off. It deletes what the class has kept on this robot."),
])
def test_what_is_typed_wrong_is_refused_in_one_sentence_and_changes_nothing(computer, words, sentence):
    check_refused(computer, words, sentence, stdin=KEY)


def check_refused(computer, words, sentence, **typed):
    before = computer.files()
    code, printed = computer.robot(*words, **typed)
    assert code == 1 and printed.startswith(sentence) and printed.count("\n") == 1
    assert computer.files() == before and not computer.calls()


@pytest.mark.parametrize("typed, sentence", [
    ({"stdin": "no key"}, "That is no key. A robot's key has 26 letters and digits; on the teacher's computer: "
                          "./morbot fleet key jetbot_07\n"),
    ({"SUDO_USER": "kim"}, "Type this without sudo. It asks for the administrator's password itself.\n"),
    ({"TAKEN": "8080"}, "Another program has port 8080, which the page needs. End it, or add another port: "
                        "cockpit_port:=8081\n"),
    ({"TAKEN": "11311"}, "A ROS master runs here already, at port 11311. End what started it, then type this again.\n"),
    ({"PATH": "/nonexistent"}, "There is no sudo here. Let an administrator install it: apt install sudo\n")])
def test_a_computer_that_cannot_is_refused_in_one_sentence(computer, typed, sentence):
    check_refused(computer, NAMED, sentence, **{"stdin": KEY, **typed})


def test_without_systemd_nothing_is_done(computer):
    (computer.root / "run/systemd/system").rmdir()
    check_refused(computer, NAMED, "Systemd does not run here, so nothing can start with the computer.", stdin=KEY)




def test_a_service_of_ones_own_is_left_alone(computer):
    unit = computer.root / "etc/systemd/system/jetbot.service"
    unit.write_text("mine")
    for words in NAMED, ["--off"]:
        code, printed = computer.robot(*words, stdin=KEY)
        assert code == 1 and printed.startswith("This computer starts a robot already, by a service of its own. End")
    assert unit.read_text() == "mine" and not computer.calls()


def test_without_avahi_it_runs_and_says_who_finds_it(computer):
    (computer.root / "etc/avahi/services").rmdir()
    code, printed = computer.robot(*NAMED, stdin=KEY)
    assert code == 0 and "Other computers do not find it by its name: sudo apt install avahi-daemon" in printed
    assert not (computer.root / AVAHI).exists()


def test_a_page_that_does_not_answer_is_named(computer):
    code, printed = computer.robot(*NAMED, stdin=KEY, ANSWERS="no")
    assert code == 1
    assert printed.endswith("Jetbot_07 is installed, but its page does not answer. This says why: sudo journalctl -u "
                            "jetbot -n 20\n")


def test_what_the_administrator_cannot_do_is_named_and_can_be_done_again(computer):
    code, printed = computer.robot(*NAMED, stdin=KEY, FAILS="hostnamectl")
    assert code == 1
    advice = "When that is corrected, type the same again.\n"
    assert printed == f"This did not succeed, see above: sudo hostnamectl set-hostname jetbot-07. {advice}"
    code, printed = computer.robot(*NAMED, stdin=KEY, FAILS="sh")
    assert printed == f"This did not succeed, see above: sudo sh -ec put {computer.root}/etc/hosts. {advice}"
    assert computer.robot(*NAMED, stdin=KEY)[0] == 0 and computer.read("etc/hostname") == "jetbot-07\n"


def test_a_file_whose_writing_is_cut_keeps_its_old_content(named):
    before = named.read(DROP_IN)
    assert named.robot("board:=sparkfun", CUT="yes")[0] == 1
    assert named.read(DROP_IN) == before
    assert named.robot("board:=sparkfun")[0] == 0 and "board:=sparkfun" in named.read(DROP_IN)


def test_without_words_it_says_what_this_robot_is(computer):
    assert computer.robot() == (1, "This computer is no robot of a class. To make it one: ./morbot robot jetbot_07 "
                                   "--class 7b\n")
    computer.robot(*NAMED, "camera:=false", stdin=KEY)
    lines = ["robot:     jetbot_07", "class:     7b", "page:      http://jetbot-07.local:8080",
             "arguments: camera:=false", f"folder:    {computer.folder / 'MorBot'}", "runs:      yes"]
    assert computer.robot() == (0, "\n".join(lines) + "\n")
    (computer.folder / "MorBot").rename(computer.folder / "moved")
    code, printed = computer.robot(FOLDER="moved")
    assert code == 1
    assert printed.endswith("The folder is gone or not built. In the folder that is to run, type: ./morbot robot "
                            "jetbot_07 --class 7b\n")


def test_off_undoes_all_and_keeps_what_the_class_has_kept_unless_told(computer):
    before = computer.files()
    for words in ["--off"], ["--off", "--forget"]:
        computer.robot(*NAMED, stdin=KEY)
        kept = computer.home / ".ros/morbot_classes/7b/codes.json"
        kept.parent.mkdir(parents=True, exist_ok=True)
        kept.write_text("{}")
        code, printed = computer.robot(*words)
        assert code == 0 and printed.endswith("This computer is no robot of a class any more, and starts none.\n")
        assert "gpasswd -d kim video" in computer.calls()
        assert kept.exists() == (len(words) == 1)
    after = computer.files()
    assert after.pop("root/etc/hosts").split() == b"127.0.0.1 localhost 127.0.1.1 nano nano.school".split()
    assert after == {name: content for name, content in before.items() if name != "root/etc/hosts"}
    assert computer.robot("--off")[0] == 0, "twice does no harm"


def test_forget_after_off_says_how_the_class_is_deleted(named):
    kept = named.home / ".ros/morbot_classes/7b/class.json"
    kept.parent.mkdir(parents=True)
    kept.write_text("{}")
    named.robot("--off")
    code, printed = named.robot("--off", "--forget")
    assert code == 0 and "To delete what the class 7b has kept here, type: ./morbot forget 7b\n" in printed


def test_a_damaged_identity_is_replaced(named):
    identity = named.home / ".ros/morbot_robot.json"
    identity.write_text("")
    code, printed = named.robot(*NAMED, stdin=KEY)
    assert code == 0, printed
    assert '"jetbot_07"' in identity.read_text()


def test_two_at_once_do_not_mix(named):
    folder = os.open(named.home, os.O_RDONLY)
    fcntl.flock(folder, fcntl.LOCK_EX)
    try:
        code, printed = named.robot("--off")
    finally:
        os.close(folder)
    assert code and "Another ./morbot robot is at work on this computer. Wait until it has ended." in printed
    assert (named.home / ".ros/morbot_robot.json").exists()


@pytest.mark.parametrize("words, before", [(NAMED, []), (["--off"], [NAMED])], ids=["name", "off"])
def test_killed_at_any_moment_it_leaves_whole_files_and_typed_again_it_heals(tmp_path, words, before):
    def make(name):
        computer = RobotComputer(tmp_path / name)
        for each in before:
            computer.robot(*each, stdin=KEY)
        return computer
    whole = make("whole")
    whole.robot(*words, stdin=KEY)
    wanted = contents(whole)
    moments = [number for number, call in enumerate(whole.calls(), 1) if not call.startswith("morbot")]
    assert len(moments) > 8
    for moment in moments:
        computer = make(str(moment))
        assert computer.robot(*words, stdin=KEY, kill_at=moment)[0] == -9, moment
        assert not [name for name, content in computer.files().items() if content == b"" and "run/" not in name], moment
        assert computer.robot(*words, stdin=KEY)[0] == 0, moment
        assert contents(computer) == wanted, moment


def contents(computer):
    """Return all files and where links lead, without the place of the computer."""
    return {name: (content if isinstance(content, str) else content.decode()).replace(str(computer.folder), "")
            for name, content in computer.files().items()}
