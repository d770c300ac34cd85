"""./morbot fleet against a real sshd and real git: what a robot has after an update, whatever happens meanwhile."""

import json
import os
import pwd
import shutil
import stat

import pytest
from fleet_robot import STATE, World, check_cut

from jetbot_class.fleet import commands, install

SHELL = pwd.getpwuid(os.geteuid()).pw_shell  # which sshd starts, whatever it is to do
pytestmark = [
    pytest.mark.shell,
    pytest.mark.skipif(not shutil.which("sshd", path="/usr/sbin:/usr/bin"), reason="needs openssh-server"),
    pytest.mark.skipif(SHELL.endswith(("nologin", "false")), reason="needs a user who may log in")]
DRIVEN = {"driver": {"id": 1, "name": "Ada", "said": None}}
ADA_DRIVES = "jetbot_07: Ada drives it: update it later, or with --force"


@pytest.fixture(scope="module")
def added(tmp_path_factory):
    """A laptop that has just added a robot."""
    with pytest.MonkeyPatch().context() as patch:
        world = World(tmp_path_factory.mktemp("world"), patch)
        try:
            assert not commands.main(["--class", "7b", "add", "127.0.0.1", f"cockpit_port:={world.robot.port}",
                                      "--name", "jetbot_07"])
            world.copy(".", "saved")
            yield world
        finally:
            world.close()


@pytest.fixture
def world(added):
    added.restore()
    return added


@pytest.fixture
def robot(world):
    return world.robot


@pytest.fixture
def laptop(world):
    return world.laptop


@pytest.fixture
def fleet(capfd):
    """A function that types a command; it returns (exit code, all that is printed)."""
    def fleet(*arguments):
        code = commands.main(list(arguments))
        return code, "".join(capfd.readouterr())
    return fleet


def test_a_robot_is_installed_named_and_listed(robot, laptop, fleet):
    first = laptop.git("rev-parse", "HEAD")
    assert robot.current() == first
    assert robot.calls()[0] == f"robot jetbot_07 --class 7b cockpit_port:={robot.port}"
    code, said = fleet("key", "jetbot_07")
    assert said.split()[1].replace("-", "") == (robot.home / "key").read_text()
    assert not (robot.morbot / "key").exists()
    assert (robot.home / "key").read_text() not in laptop.ssh_arguments(), "others see the arguments of a program"
    code, said = fleet()
    assert code == 0 and said.splitlines()[1].split()[:3] == ["jetbot_07", f"127.0.0.1:{robot.port}", first[:8]], said
    hosts = laptop.home / ".ros/morbot_classes/7b/known_hosts"
    assert hosts.exists() and stat.S_IMODE(hosts.parent.stat().st_mode) == 0o700


def test_an_update_is_built_beside_the_old_version_and_two_versions_are_kept(robot, laptop, fleet):
    versions = [robot.current()]
    for number in "12":
        versions.append(laptop.commit("next", news=number))
        code, said = fleet("update")
        assert code == 0 and f"jetbot_07 runs {versions[-1][:8]}" in said, said
        files, restart = robot.calls()[-2:]
        assert files.strip() == f"{versions[-1]} robot --files" and restart.startswith("systemctl restart")
        assert robot.current() == versions[-1] and robot.versions() == set(versions[-2:])
    calls = robot.calls()
    assert fleet("update")[0] == 0  # it runs already
    assert [call.split()[1:] for call in robot.calls()[len(calls):]] == [["robot", "--files"]]


@pytest.mark.parametrize("fault, reason", [
    ("does_not_start", "runs the old one again"), ("does_not_build", "cannot be built"), ("ill", "doctor finds")])
def test_a_version_that_fails_leaves_the_old_one_running(robot, laptop, fleet, fault, reason):
    first = robot.current()
    laptop.commit("bad", **{fault: ""})
    code, said = fleet("update", "--within", "1")
    assert code == 1 and reason in said, said
    assert robot.current() == first
    assert fault != "does_not_start" or robot.calls()[-2].strip() == f"{first} robot --files"
    assert fleet()[1].splitlines()[1].split()[2] == first[:8]
    (laptop.checkout / fault).unlink()
    fixed = laptop.commit("fixed")
    assert fleet("update")[0] == 0 and robot.current() == fixed


def test_of_two_versions_that_fail_the_one_that_has_answered_last_runs_again(robot, laptop, fleet, monkeypatch):
    good = laptop.commit("good", news="1")
    assert fleet("update")[0] == 0
    bad = laptop.commit("bad", does_not_start="")
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):  # the lid of the laptop, while it waits
        patch.setattr(install, "runs", lambda *_: exec("raise KeyboardInterrupt"))
        fleet("update")
    assert robot.current() == bad
    laptop.commit("as bad", news="2")
    code, said = fleet("update", "--within", "1")
    assert code == 1 and "runs the old one again" in said, said
    assert robot.current() == good and good[:8] in fleet()[1]


def test_an_old_version_that_does_not_run_either_is_named(robot, laptop, fleet):
    (robot.morbot / "current/does_not_start").touch()
    laptop.commit("bad", does_not_start="")
    code, said = fleet("update", "--within", "1")
    assert code == 1 and "nor with the old one: ./morbot fleet log jetbot_07" in said, said


def test_a_fault_that_the_old_version_finds_too_hinders_no_update(robot, laptop, fleet):
    (robot.home / "ill").touch()
    second = laptop.commit("second")
    assert fleet("update")[0] == 0 and robot.current() == second


def test_a_robot_that_is_driven_is_not_updated(robot, laptop, fleet):
    first = robot.current()
    robot.says(**DRIVEN)
    second = laptop.commit("second")
    code, said = fleet("update")
    assert code == 1 and ADA_DRIVES in said
    assert robot.current() == first
    code, said = fleet("update", "--force")
    assert code == 0 and robot.current() == second, said


def test_who_begins_to_drive_while_the_version_is_built_drives_on(robot, laptop, fleet):
    first, calls = robot.current(), robot.calls()
    second = laptop.commit("second", driven_meanwhile=json.dumps({**STATE, **DRIVEN}))
    code, said = fleet("update")
    assert code == 1 and ADA_DRIVES in said
    assert robot.current() == first and robot.versions() == {first, second}
    assert robot.calls() == calls, "nothing was started again"


def test_a_robot_that_is_turned_off_starts_whole_and_the_next_update_heals(world):
    for moment in (13, 25, 27):  # while it is unpacked, linked and started; all others: tests/fleet/test_update.py
        check_cut(world, moment)


@pytest.mark.parametrize("damaged", ["objects/pack/*", "config"])
def test_a_damaged_repository_is_replaced(robot, laptop, fleet, damaged):
    for file in robot.morbot.glob(f"repository/{damaged}"):
        file.write_bytes(b"\0" * 10) if file.suffix == "" else file.unlink()
    second = laptop.commit("second", news="1")
    code, said = fleet("update")
    assert code == 0 and robot.current() == second, said


def test_another_host_key_is_named(laptop, fleet):
    known = laptop.home / ".ros/morbot_classes/7b/known_hosts"
    host, kind, _ = known.read_text().split()
    known.write_text(f"{host} {kind} {laptop.public_key}\n")
    code, said = fleet("update")
    assert code == 1 and "127.0.0.1 has another host key than before" in said, said


def test_without_sshd_and_without_a_checkout_one_sentence_says_so(robot, laptop, fleet, monkeypatch):
    robot.stop_sshd()
    code, said = fleet("log", "jetbot_07")
    assert code == 1 and said.strip().count("\n") == 0 and "127.0.0.1 has no ssh running" in said, said
    shutil.rmtree(laptop.checkout / ".git")
    monkeypatch.setenv("GIT_CEILING_DIRECTORIES", str(laptop.checkout.parent))
    code, said = fleet("update")
    assert code == 1 and "not a git repository" in said, said


def test_the_log_comes_over_ssh(world, fleet):
    code, said = fleet("log", "jetbot_07", "-f")
    assert code == 0 and "--no-pager --follow --lines=200" in said, said


def test_a_class_is_forgotten_on_its_robots_and_stays_where_one_is_out_of_reach(robot, laptop, fleet):
    fleet("add", "--address", "127.0.0.1:9", "jetbot_08")
    code, said = fleet("forget", "--yes")
    assert code == 1 and "still on jetbot_08" in said, said
    assert robot.calls()[-1].startswith("robot --off --forget")
    fleet("add", "jetbot_07", "--address", "127.0.0.1")  # as if it was cut before the list was written
    listed = laptop.home / ".ros/morbot_classes/7b/fleet.json"
    listed.write_text(listed.read_text().replace('"login": ""', '"login": "127.0.0.1"', 1))
    assert "jetbot_07 has forgotten the class" in fleet("forget", "--yes")[1]
    assert fleet("remove", "jetbot_08")[0] == 0
    assert fleet("forget", "--yes")[0] == 0
    assert not (laptop.home / ".ros/morbot_classes/7b").exists()


def test_a_robot_that_cannot_be_set_up_is_named_and_gets_no_key(robot, laptop, fleet):
    laptop.commit("bad", does_not_build="")
    code, said = fleet("add", "127.0.0.1", f"cockpit_port:={robot.port}")
    assert code == 1 and "it did not succeed on 127.0.0.1 (see above)" in said, said
    assert not list(robot.morbot.rglob("key"))
