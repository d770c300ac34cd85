"""A robot that is turned off at each command of an update; and the real programs, installed and updated once.

They need no network namespaces.
"""

import os
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[1] / "unit"))
from fleet_robot import ROOT, World, check_cut, write  # noqa: E402

from jetbot_class.fleet import commands  # noqa: E402

pytestmark = pytest.mark.skipif(not shutil.which("sshd", path="/usr/sbin:/usr/bin"), reason="needs openssh-server")
MOST = 60  # commands of an update
SYSTEMCTL = """#!/bin/sh
# Ends what the service has started, and starts it again.
[ ! -e "$HOME/pid" ] || kill -TERM "-$(cat "$HOME/pid")" 2>/dev/null
while [ -e "$HOME/pid" ] && kill -0 "-$(cat "$HOME/pid")" 2>/dev/null; do sleep 0.1; done
folder=$HOME/.local/share/morbot/current/morbot_ws
[ "$1" != stop ] || exit 0
export ROS_MASTER_URI=http://localhost:{master} ROS_HOSTNAME=localhost ROS_ETC_DIR=$folder/etc PATH=/usr/bin:/bin
setsid "$folder/devel/env.sh" roslaunch -p {master} jetbot_class robot.launch robot:=jetbot_07 \\
    cockpit_port:={port} i2c_bus:=fake camera:=false pictures:=false >>"$HOME/log" 2>&1 </dev/null &
echo $! >"$HOME/pid"
"""
NAMED = """import subprocess, sys
from pathlib import Path
from jetbot_cockpit.remote import identity
if sys.argv[1] == "--files":
    sys.exit()
robot, _, class_name, *_ = sys.argv[1:]
identity.write(identity.Identity(robot, class_name, sys.stdin.read()))
(Path.home() / ".local/share/morbot/current").symlink_to(Path(__file__).resolve().parents[4])
subprocess.run([Path.home().parent / "commands/systemctl", "restart"], check=True)
"""  # in place of ./morbot robot, which changes this computer
LEFT_OUT = shutil.ignore_patterns("build", "devel", ".git", "node_modules", "__pycache__", ".pytest_cache",
                                  ".hypothesis")


def real_version(checkout):
    shutil.copytree(ROOT, checkout, ignore=LEFT_OUT)
    write(checkout / "morbot_ws/src/jetbot_class/scripts/robot.py", NAMED)
    write(checkout / "last_file", "")


def test_the_real_programs_are_built_on_the_robot_started_and_updated(tmp_path, monkeypatch, capfd):
    world = World(tmp_path, monkeypatch, SYSTEMCTL, real_version)
    robot = world.robot
    try:
        assert commands.main(["--class", "7b", "add", "127.0.0.1", f"cockpit_port:={robot.port}", "--name",
                              "jetbot_07"]) == 0, (robot.home / "log").read_text()
        first = robot.current()
        second = world.laptop.commit("second", news="1")
        assert commands.main(["update"]) == 0, (robot.home / "log").read_text()
        assert robot.current() == second and robot.versions() == {first, second}
        capfd.readouterr()
        assert commands.main([]) == 0
        assert capfd.readouterr().out.splitlines()[1].split()[2] == second[:8]
    finally:
        world.close()
        subprocess.run([tmp_path / "systemctl", "stop"], check=True, env={**os.environ, "HOME": str(robot.home)})


def test_a_robot_turned_off_at_any_command_starts_whole_and_the_next_update_heals(tmp_path, monkeypatch):
    world = World(tmp_path, monkeypatch)
    try:
        assert commands.main(["--class", "7b", "add", "127.0.0.1", f"cockpit_port:={world.robot.port}"]) == 0
        moments = 1
        while check_cut(world, moments):
            moments += 1
            assert moments < MOST
        assert moments > 20
    finally:
        world.close()
