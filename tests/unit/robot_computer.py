"""A computer on which ./morbot robot runs: with a root, a home and administrator's tools of its own."""

import json
import os
import pty
import subprocess
import sys
from pathlib import Path

from conftest import PYTHONPATH, ROOT
from jetbot_cockpit.remote.key import robot_key

KEY = robot_key("A" * 26, "jetbot_07")
PROGRAM = """
import os, socket, sys
from pathlib import Path
root = Path(sys.argv[1])
socket.gethostname = lambda: (root / "etc/hostname").read_text().strip()
os.getuid = lambda: 1000
from jetbot import JetbotError
from jetbot_class.robot import commands, computer, service
service.ROOT = root.parent / os.environ["FOLDER"]
commands.is_free = lambda port: str(port) not in os.environ["TAKEN"].split()
commands.answers, commands.READY_TIMEOUT = (lambda port: os.environ["ANSWERS"] == "yes"), 0
try:
    sys.exit(commands.main(sys.argv[2:], computer.Computer(root)))
except JetbotError as error:
    sys.exit(str(error))
"""
SUDO = """echo "$@" >>"$LOG"
[ "$(wc -l <"$LOG")" != "$KILL_AT" ] || { kill -9 $PPID; exit 1; }
[ "$1" != "$FAILS" ] || exit 1
exec "$@"
"""
SYSTEMCTL = """case $1 in
    is-active) [ -e "$ROOT/run/active" ] && echo active || echo inactive ;;
    restart) touch "$ROOT/run/active" ;;
    disable) rm -f "$ROOT/run/active" ;;
esac"""
TOOLS = {"sudo": SUDO, "systemctl": SYSTEMCTL, "hostnamectl": 'echo "$2" >"$ROOT/etc/hostname"', "usermod": ":",
         "gpasswd": ":", "id": "echo kim i2c", "getent": '[ "$2" != dialout ] && echo "$2:x:100:"',
         "sync": '[ -z "$CUT" ] || kill -9 $PPID', "hostname": "echo 192.168.1.17"}
MORBOT = 'echo "morbot $*" >>"$LOG"; [ "$1" != doctor ]\n'


class RobotComputer:
    """folder: where all is; root: of the computer's files; home: of its user."""

    def __init__(self, folder: Path):
        self.folder, self.root, self.home, self.log = folder, folder / "root", folder / "home", folder / "log"
        for each in ("run/systemd/system", "etc/systemd/system", "etc/avahi/services"):
            (self.root / each).mkdir(parents=True)
        self.home.mkdir()
        (self.root / "etc/hostname").write_text("nano\n")
        (self.root / "etc/hosts").write_text("127.0.0.1 localhost\n127.0.1.1 nano.school nano\n")
        (folder / "bin").mkdir()
        for name, body in TOOLS.items():
            script(folder / "bin" / name, body)
        self.checkout("MorBot")

    def checkout(self, name):
        """Make a folder with MorBot, built."""
        (self.folder / name / "morbot_ws/devel").mkdir(parents=True)
        (self.folder / name / "morbot_ws/devel/env.sh").touch()
        (self.folder / name / "morbot_ws/src").symlink_to(ROOT / "morbot_ws/src")
        (self.folder / name / "systemd").symlink_to(ROOT / "systemd")
        script(self.folder / name / "morbot", MORBOT)

    def robot(self, *words, stdin="", terminal=False, kill_at=0, **environment):
        """Run ./morbot robot; return its exit code and output. kill_at: the call of sudo at which it is killed."""
        self.log.write_text("")
        environment = {"HOME": str(self.home), "PATH": f"{self.folder}/bin:/usr/bin:/bin", "PYTHONPATH": PYTHONPATH,
                       "LOG": str(self.log), "ROOT": str(self.root), "KILL_AT": str(kill_at), "FOLDER": "MorBot",
                       "TAKEN": "", "FAILS": "", "CUT": "",
                       "ANSWERS": "yes", "LOGNAME": "kim", "LANG": "C.UTF-8", **environment}
        command = [sys.executable, "-c", PROGRAM, self.root, *words]
        options = {"env": environment, "stdout": subprocess.PIPE, "stderr": subprocess.STDOUT, "text": True,
                   "timeout": 60, "check": False}
        if not terminal:
            done = subprocess.run(command, input=stdin, **options)
            return done.returncode, done.stdout
        keyboard, screen = pty.openpty()
        try:
            os.write(keyboard, stdin.encode())
            done = subprocess.run(command, stdin=screen, **options)
        finally:
            os.close(keyboard)
            os.close(screen)
        return done.returncode, done.stdout

    def calls(self):
        """Return the commands of the last run that were run as root."""
        return self.log.read_text().splitlines()

    def read(self, file):
        """Return the text of a file below the root."""
        return (self.root / file).read_text()

    def identity(self):
        """Return what the robot's identity says."""
        return json.loads((self.home / ".ros/morbot_robot.json").read_text())

    def runs(self):
        """Return which folder the service starts."""
        return os.readlink(self.home / ".local/share/morbot/current")

    def files(self):
        """Return all files and links, with their contents."""
        return {str(path.relative_to(self.folder)): path.read_bytes() if path.is_file() else os.readlink(path)
                for top in (self.root, self.home) for path in sorted(top.rglob("*"))
                if path.is_file() or path.is_symlink()}


def script(path, body):
    """Write a program."""
    path.write_text(f"#!/bin/sh\n{body}\n")
    path.chmod(0o755)
