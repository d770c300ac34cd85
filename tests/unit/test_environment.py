"""Several users of one computer do not disturb each other: master, home and build, with a fake id."""

import os
import stat
import subprocess

import pytest

from conftest import ROOT

SCRIPT = """set -eu
fail() {{ echo "$*" >&2; exit 1; }}
id() {{ [ "$1" != -u ] && echo pupil || echo {user}; }}
here={here} workspace={here}/morbot_ws command=shell
. "{root}/setup/environment.sh"
. "{root}/setup/build.sh"
{commands}
"""


@pytest.fixture
def shell(tmp_path):
    """Return a function that runs commands in setup's functions, as a user, and returns what they print."""
    (tmp_path / "home").mkdir()

    def run(commands, user=1001, **environment):
        script = SCRIPT.format(user=user, here=tmp_path, root=ROOT, commands=commands)
        process = subprocess.run(["sh", "-c", script], env={"PATH": "/usr/bin:/bin", "HOME": str(tmp_path / "home"),
                                                            **environment}, stdout=subprocess.PIPE, encoding="utf-8")
        assert process.returncode == 0
        return process.stdout.strip()

    return run


def master(shell, user, **environment):
    return shell("environment; echo ${ROS_MASTER_URI:-none}", user, **environment)


def test_the_first_user_and_root_have_the_usual_master(shell):
    assert master(shell, 0) == master(shell, 1000) == "none"


def test_other_users_have_masters_of_their_own(shell):
    uris = {master(shell, user) for user in (1001, 1002, 30001)}
    assert len(uris) == 3 and all(12000 <= int(uri.rpartition(":")[2]) < 32000 for uri in uris)
    assert master(shell, 1001) in uris


def test_a_master_that_is_set_is_used(shell):
    assert master(shell, 1001, ROS_MASTER_URI="http://robot:11311") == "http://robot:11311"


@pytest.mark.parametrize("uri, port", [
    (None, "11311"), ("http://localhost:13001", "13001"), ("http://a:13001/", "13001")])
def test_roscore_starts_where_the_master_is_expected(tmp_path, uri, port):
    real = tmp_path / "roscore"
    real.write_text('#!/bin/sh\necho "$@"\n')
    real.chmod(0o755)
    script = (ROOT / "morbot_ws/etc/bin/roscore").read_text().replace("/usr/bin/roscore", str(real))
    environment = {"PATH": "/usr/bin:/bin", **({"ROS_MASTER_URI": uri} if uri else {})}
    printed = subprocess.run(["sh", "-c", script.replace("/opt/ros", "/nonexistent"), "roscore", "-v"], env=environment,
                             stdout=subprocess.PIPE, encoding="utf-8").stdout
    assert printed == f"-p {port} -v\n"


def test_settings_are_in_the_users_home(shell):
    assert shell("environment; echo ${ROS_HOME:-none}") == "none"


def test_without_a_home_settings_and_logs_are_in_a_folder_of_the_user(shell, tmp_path):
    place = shell("environment; echo $ROS_HOME", os.getuid(), HOME="/nonexistent", TMPDIR=str(tmp_path))
    assert place == f"{tmp_path}/morbot-{os.getuid()}/ros"
    assert stat.S_IMODE((tmp_path / f"morbot-{os.getuid()}").stat().st_mode) == 0o700


def test_a_cache_folder_that_is_named_is_made(shell, tmp_path):
    place = shell("choose_cache; echo $cache", XDG_CACHE_HOME=str(tmp_path / "xdg"))
    assert place == f"{tmp_path}/xdg/morbot" and os.path.isdir(place)


@pytest.mark.skipif(os.getuid() == 0, reason="root may read all")
def test_a_build_whose_folder_cannot_be_read_is_not_used(shell, tmp_path):
    (tmp_path / "morbot_ws/build").mkdir(parents=True)
    (tmp_path / "morbot_ws/build").chmod(0)
    assert "/.cache/morbot/" in shell("is_built() { true; }; choose_build; echo $build")


@pytest.mark.parametrize("closed, built, place", [
    ("nothing", False, "morbot_ws/build"),
    ("morbot_ws", True, "morbot_ws/build"),
    ("morbot_ws", False, "home/.cache/morbot{}/morbot_ws/build"),
    ("morbot_ws/devel", False, "home/.cache/morbot{}/morbot_ws/build")])
def test_a_workspace_that_a_user_may_not_write_is_built_in_their_home(shell, tmp_path, closed, built, place):
    (tmp_path / "morbot_ws/build").mkdir(parents=True)
    chosen = shell(f"""may_write() {{ case " $* " in *" {tmp_path}/{closed} "*) return 1 ;; esac; }}
        is_built() {{ {"true" if built else "false"}; }}
        choose_build; echo $build""")
    assert chosen == f"{tmp_path}/{place.format(tmp_path)}" and os.path.isdir(chosen)


@pytest.mark.parametrize("source, kept", [("{}/morbot_ws/src", True), ("{}/morbot_ws/build/view/src", True),
                                          ("/elsewhere/MorBot/morbot_ws/src", False)])
def test_a_build_of_another_folder_is_removed_also_without_its_setup_sh(shell, tmp_path, source, kept):
    devel = tmp_path / "morbot_ws/devel"
    devel.mkdir(parents=True)
    (devel / "morbot.stamp").write_text(f"{source.format(tmp_path)}\n")
    assert shell("python3() { echo builds; }; choose_build; build") == "builds"
    assert devel.exists() == kept
