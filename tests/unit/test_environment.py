"""Several users of one computer: whose home, whose build, which master; with a fake id."""

import os
import stat
import subprocess

import pytest

from conftest import ROOT

SCRIPT = """set -eu
fail() {{ echo "$*" >&2; exit 1; }}
id() {{ [ "$1" != -u ] && echo pupil || echo {user}; }}
here={here} workspace={here}/morbot_ws command=shell
. "{root}/setup/workspace.sh"
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


@pytest.mark.parametrize("user", [0, 1000, 1001])
def test_all_users_have_the_usual_master_or_the_one_that_is_set(shell, user):
    assert shell("environment; echo ${ROS_MASTER_URI:-none}", user) == "none"
    uri = "http://robot:11311"
    assert shell("environment; echo $ROS_MASTER_URI", user, ROS_MASTER_URI=uri) == uri


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


@pytest.mark.skipif(os.getuid() == 0, reason="root may write all")
def test_without_a_home_settings_and_logs_are_in_a_folder_of_the_user(shell, tmp_path):
    place = shell("environment; echo $ROS_HOME", os.getuid(), HOME="/nonexistent", TMPDIR=str(tmp_path))
    assert place == f"{tmp_path}/morbot-{os.getuid()}/ros"
    assert stat.S_IMODE((tmp_path / f"morbot-{os.getuid()}").stat().st_mode) == 0o700


@pytest.mark.parametrize("place", [".ros", ".ros/log"])
@pytest.mark.parametrize("make", [os.mknod, lambda path: os.symlink("nowhere", path)], ids=["file", "dangling link"])
def test_where_ros_has_no_folder_it_gets_another(shell, tmp_path, place, make):
    (tmp_path / "home" / place).parent.mkdir(exist_ok=True)
    make(tmp_path / "home" / place)
    assert shell("environment; echo $ROS_HOME") == f"{tmp_path}/home/.cache/morbot/ros"


def test_a_cache_folder_that_is_named_is_made(shell, tmp_path):
    place = shell("choose_cache; echo $cache", XDG_CACHE_HOME=str(tmp_path / "xdg"))
    assert place == f"{tmp_path}/xdg/morbot" and os.path.isdir(place)


def test_a_stop_needs_no_folder(shell):
    assert shell("command=stop; choose_cache; echo on", XDG_CACHE_HOME="/dev/null", TMPDIR="/dev/null") == "on"


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


@pytest.mark.skipif(os.getuid() == 0, reason="root may write all")
def test_a_fresh_clone_that_a_user_may_not_write_is_built_from_links_to_it(shell, tmp_path):
    (tmp_path / "morbot_ws/src/mine").mkdir(parents=True)
    (tmp_path / "morbot_ws/src").chmod(0o555)
    source = shell("python3() { mkdir -p $4; ls $2; }; may_write() { false; }; choose_build; build")
    assert source == "mine"


BUILD = "python3() { echo builds; mkdir -p $devel; echo : >$devel/setup.sh; }; choose_build; build"


@pytest.fixture
def workspace(tmp_path):
    (tmp_path / "morbot_ws/src/mine").mkdir(parents=True)
    (tmp_path / "morbot_ws/src/mine/package.xml").touch()
    return tmp_path / "morbot_ws"


def test_only_what_has_changed_is_built_again(shell, workspace):
    assert shell(BUILD) == "builds"
    (workspace / "src/mine/__pycache__").mkdir()
    (workspace / "src/mine/node.py").touch()
    assert shell(BUILD) == ""
    (workspace / "src/mine/CMakeLists.txt").touch()
    assert shell(BUILD) == "builds"
    (workspace / "src/mine").rename(workspace / "src/yours")
    assert shell(BUILD) == "builds"


def test_what_a_power_cut_has_left_empty_is_built_again(shell, workspace):
    assert shell(BUILD) == "builds"
    (workspace / "devel/setup.sh").write_text("")
    assert shell(BUILD) == "builds"
    assert shell(BUILD) == ""


def test_setup_tries_again_what_was_left_out(shell, workspace):
    assert shell(BUILD) == "builds"
    assert shell(f"command=setup; {BUILD}") == ""
    (workspace / "src/mine/CATKIN_IGNORE").write_text("morbot: the reason\n")
    assert shell(BUILD) == "" and shell("left_out") == "morbot: the reason"
    assert shell(f"command=setup; {BUILD}") == "builds"


def test_a_build_that_fails_is_made_again_and_the_last_one_stays_in_use(shell, workspace):
    assert shell(BUILD) == "builds"
    (workspace / "src/mine/CMakeLists.txt").touch()
    assert shell("python3() { return 1; }; choose_build; build 2>&1") == "morbot: going on with the last build"
    (workspace / "build/CMakeCache.txt").touch()
    assert shell(BUILD) == "builds"
    assert not (workspace / "build/CMakeCache.txt").exists(), "CMake does not continue what was interrupted"


def test_a_build_of_another_folder_is_removed(shell, workspace):
    assert shell(BUILD) == "builds"
    (workspace / "build/CMakeCache.txt").touch()
    (workspace / "devel/morbot.stamp").write_text("/elsewhere/MorBot/morbot_ws/src/mine/package.xml 1.0\n")
    (workspace / "devel/old").touch()
    shell(BUILD)
    assert not (workspace / "devel/old").exists() and not (workspace / "build/CMakeCache.txt").exists()
