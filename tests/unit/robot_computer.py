"""A computer on which ./morbot robot runs: with a root, a home and administrator's tools of its own."""

import json
import os
import pty
import signal
import socket
import sys
import tempfile
import traceback
from pathlib import Path

from conftest import PYTHONPATH, ROOT
from jetbot import JetbotError
from jetbot_class.robot import commands, computer, service
from jetbot_cockpit.remote.key import robot_key

TIMEOUT = 60  # s

KEY = robot_key("A" * 26, "jetbot_07")
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
        keyboard, screen = pty.openpty()
        with tempfile.TemporaryFile("w+") as typed, tempfile.TemporaryFile("w+") as printed:
            typed.write(stdin)
            typed.seek(0)
            os.write(keyboard, stdin.encode())
            child = os.fork()  # a new Python would import all again each time
            if not child:
                self._type(words, environment, screen if terminal else typed.fileno(), printed.fileno())
            _, status = os.waitpid(child, 0)
            for end in keyboard, screen:
                os.close(end)
            printed.seek(0)
            return -os.WTERMSIG(status) if os.WIFSIGNALED(status) else os.WEXITSTATUS(status), printed.read()

    def _type(self, words, environment, *files):
        """Be the process of ./morbot robot on this computer. files: its input and its output."""
        code = 1
        try:
            signal.alarm(TIMEOUT)
            for number, file in enumerate([*files, files[-1]]):
                os.dup2(file, number)
            sys.stdin, sys.stdout, sys.stderr = open(0), open(1, "w"), open(2, "w")
            os.environ.clear()
            os.environ.update(environment)
            socket.gethostname = lambda: self.read("etc/hostname").strip()
            os.getuid = lambda: 1000
            service.ROOT = self.folder / environment["FOLDER"]
            commands.is_free = lambda port: str(port) not in environment["TAKEN"].split()
            commands.answers, commands.READY_TIMEOUT = (lambda port: environment["ANSWERS"] == "yes"), 0
            code = commands.main(list(words), computer.Computer(self.root))
        except JetbotError as error:
            print(error, file=sys.stderr)
        except BaseException:
            traceback.print_exc()
        finally:
            sys.stdout.flush()
            sys.stderr.flush()
            os._exit(code)

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
