"""A robot that ./morbot fleet reaches: a real sshd, a home of its own, and a service that talks as a cockpit does."""

import contextlib
import json
import os
import shutil
import signal
import socket
import subprocess
import sys
import time
from pathlib import Path

from processes import end, free_port, start

ROOT = Path(__file__).resolve().parents[2]
PACKAGES = ROOT / "morbot_ws/src"
CHECKOUT = "jetbot", "jetbot_ros", "jetbot_cockpit", "jetbot_class", "jetbot_control_node"  # for ./morbot fleet
COMMANDS = ("git", "tar", "mkdir", "ln", "mv", "touch", "sync", "rm", "readlink", "df", "flock", "cat", "systemctl")
STATE = {"status": "stopped", "state": "stopped", "answers": True, "driver": None, "program": "", "health": None}
TIMEOUT = 120.0  # s, for a computer that does much else
OWN_RUN = [] if os.geteuid() else [  # root's sshd wants a folder in /run, and gets a /run of its own
    "unshare", "--mount", "sh", "-c", 'mount -t tmpfs run /run && mkdir /run/sshd && exec "$@"', "sh"]

MORBOT = """#!/bin/sh
# A small version of MorBot, for the tests of ./morbot fleet.
here=$(cd "$(dirname "$0")" && pwd -P)
case $1 in
    setup)
        [ ! -e "$here/driven_meanwhile" ] || cp "$here/driven_meanwhile" "$HOME/state"
        [ ! -e "$here/does_not_build" ] ;;
    doctor) [ ! -e "$here/ill" ] && [ ! -e "$HOME/ill" ] ;;
    robot)
        [ "$2" != --files ] || { echo "${here##*/} robot --files" >>"$HOME/calls"; exit; }
        echo "robot $2 $3 $4 $5" >>"$HOME/calls"
        [ "$2" != --off ] || { rm "$HOME/.local/share/morbot/current"; exit; }
        cat >"$HOME/key"
        echo "$2 $4 ${5#*=}" >"$HOME/identity"
        ln -sfn "$here" "$HOME/.local/share/morbot/current"
        systemctl restart ;;
esac
"""
SYSTEMCTL = """#!/bin/sh
echo "systemctl $*" >>"$HOME/calls"
[ ! -e "$HOME/pid" ] || kill "$(cat "$HOME/pid")" 2>/dev/null
setsid {python} "$HOME/.local/share/morbot/current/serve.py" >>"$HOME/log" 2>&1 </dev/null &
echo $! >"$HOME/pid"
"""
SERVE = '''"""Answers a hub as the cockpit of a robot does: challenge, proof, state, pong."""
import json
import sys
from pathlib import Path

folder = Path(__file__).resolve().parent
for source in (folder / "morbot_ws/src").glob("*/src"):
    sys.path.insert(0, str(source))
from jetbot_cockpit.remote.key import HUB, ROBOT, new_nonce, proof, proves
from jetbot_cockpit.remote.version import version_of
from tornado.ioloop import IOLoop
from tornado.web import Application
from tornado.websocket import WebSocketHandler

HOME = Path.home()
if (folder / "does_not_start").exists():
    sys.exit("this version does not start")
robot, class_name, port = (HOME / "identity").read_text().split()
key = (HOME / "key").read_text()


class Hub(WebSocketHandler):
    def open(self):
        self.challenge = {"type": "challenge", "robot": robot, "class": class_name, "nonce": new_nonce(),
                          "instance": "1"}
        self.write_message(self.challenge)

    def on_message(self, text):
        message = json.loads(text)
        if message["type"] == "answer":
            assert proves(message["proof"], key, HUB, self.challenge, message)
            self.write_message({"type": "proof", "proof": proof(key, ROBOT, self.challenge, message),
                                "version": version_of(folder)})
            self.write_message({"type": "state", "emergency": False,
                                "robots": {f"/{robot}": json.loads((HOME / "state").read_text())}})
        elif message["type"] == "ping":
            self.write_message({"type": "pong", "sent": message["sent"]})


Application([("/hub", Hub)]).listen(int(port), "127.0.0.1", reuse_port=True)  # its predecessor may still be ending
IOLoop.current().start()
'''
# Everything of the robot's side ends here, at the command that "cut" counts down to: its switch was turned off.
COUNTED = """#!/bin/sh
if [ -e "$HOME/cut" ]; then
    exec 8>"$HOME/counts"  # those of a pipe one after the other
    /usr/bin/flock 8
    left=$(($(/bin/cat "$HOME/cut") - 1))
    echo $left >"$HOME/cut"
    if [ $left -le 0 ]; then
        /bin/rm "$HOME/cut"
        [ ! -e "$HOME/pid" ] || kill -9 "$(/bin/cat "$HOME/pid")"
        kill -9 0
    fi
    exec 8>&-
fi
exec {command} "$@"
"""


def write(path, text, mode=0o755):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(mode)
    return path


class Robot:
    """Its home, its sshd, its service. commands: first on its PATH."""

    def __init__(self, folder, systemctl=SYSTEMCTL):
        self.home, self.port, self.ssh_port = folder / "robot", free_port(), free_port()
        self._folder, self._sshd = folder, None
        self.home.mkdir()
        self.says()
        self.commands = folder / "commands"
        values = {"python": sys.executable, "port": self.port, "master": free_port()}
        service = write(folder / "systemctl", systemctl.format(**values))
        for name in COMMANDS:
            real = service if name == "systemctl" else "/bin/true" if name == "sync" else shutil.which(name)
            write(self.commands / name, COUNTED.format(command=real))
        write(self.commands / "journalctl", '#!/bin/sh\necho "journalctl $*"\n')
        write(self.commands / "sudo", '#!/bin/sh\nexec "$@"\n')  # where the tests are a user's
        write(folder / "login", f'#!/bin/sh\nexport HOME={self.home} PATH={self.commands}:/usr/bin:/bin\ncd\n'
                                'exec sh -c "$SSH_ORIGINAL_COMMAND"\n')
        make_key(folder / "host_key")
        self.start_sshd()

    def start_sshd(self):
        config = write(self._folder / "sshd_config", f"""
Port {self.ssh_port}
ListenAddress 127.0.0.1
HostKey {self._folder}/host_key
AuthorizedKeysFile {self._folder}/id.pub
PermitRootLogin yes
StrictModes no
UsePAM no
PidFile none
ForceCommand {self._folder}/login
""")
        self._sshd = start([*OWN_RUN, "/usr/sbin/sshd", "-D", "-e", "-f", str(config)], self._folder / "sshd.log")
        wait(lambda: accepts(self.ssh_port), self._sshd.log.read_text)

    def stop_sshd(self):
        end([self._sshd])

    def says(self, **state):
        """Let its next cockpit say this."""
        (self.home / "state").write_text(json.dumps({**STATE, **state}))

    def cut_at(self, number):
        """Turn it off at the command with this number from now on."""
        (self.home / "cut").write_text(str(number))

    def was_cut(self):
        return not (self.home / "cut").exists()

    def boot(self):
        """Start it again, as systemd does, and wait until it answers."""
        (self.home / "cut").unlink(missing_ok=True)
        subprocess.run([str(self._folder / "systemctl"), "boot"], check=True,
                       env={**os.environ, "HOME": str(self.home)})
        wait(lambda: accepts(self.port), (self.home / "log").read_text)

    @property
    def morbot(self):
        return self.home / ".local/share/morbot"

    def current(self):
        """Return the commit that it starts with, whose folder must be whole."""
        version = (self.morbot / "current").resolve()
        assert (version / "whole").exists() and (version / "last_file").exists(), version
        return version.name

    def versions(self):
        return {version.name for version in (self.morbot / "versions").iterdir()}

    def calls(self):
        return (self.home / "calls").read_text().splitlines()

    def close(self):
        self.stop_sshd()
        self.end_service()

    def end_service(self):
        if not (self.home / "pid").exists():
            return
        group = int((self.home / "pid").read_text())
        with contextlib.suppress(ProcessLookupError):
            os.killpg(group, signal.SIGTERM)
            with contextlib.suppress(AssertionError):
                wait(lambda: os.killpg(group, 0), timeout=20.0)  # until there is none
            os.killpg(group, signal.SIGKILL)


class Laptop:
    """A checkout with commits of its own, and ./morbot fleet from there."""

    def __init__(self, folder, robot, fill):
        self.home, self.checkout, self.robot = folder / "laptop", folder / "checkout", robot
        self.home.mkdir()
        make_key(folder / "id")
        self.public_key = (folder / "id.pub").read_text().split()[1]
        config = write(folder / "ssh_config", f"Port {robot.ssh_port}\nIdentityFile {folder}/id\nIdentitiesOnly yes\n"
                                              "BatchMode yes\n", 0o600)
        self._ssh_log = folder / "ssh_arguments"
        write(folder / "bin/ssh", f'#!/bin/sh\necho "$*" >>{self._ssh_log}\n'
                                  f'exec {shutil.which("ssh")} -F {config} "$@"\n')
        self.environment = {**os.environ, "HOME": str(self.home), "PATH": f"{folder}/bin:{os.environ['PATH']}"}
        fill(self.checkout)
        self.git("init", "-q")
        self.commit("first")

    def git(self, *arguments):
        command = ["git", "-C", str(self.checkout), "-c", "user.name=a", "-c", "user.email=a@b", *arguments]
        return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout.strip()

    def commit(self, message, **files):
        """Make a version with these files; return its commit."""
        for name, text in files.items():
            (self.checkout / name).write_text(text)
        self.git("add", "-A")
        self.git("commit", "-q", "--allow-empty", "-m", message)
        return self.git("rev-parse", "HEAD")

    def without(self, name):
        """Make a version without a file; return its commit."""
        (self.checkout / name).unlink()
        return self.commit(f"without {name}")

    def ssh_arguments(self):
        """Return what ssh was given at all of its starts, without the dashes of keys that people type."""
        return self._ssh_log.read_text().replace("-", "")

    def fleet(self, *arguments, **environment):
        """Type a command; return (exit code, all that it printed)."""
        with self.begin(*arguments, **environment) as running:
            said, _ = running.communicate(timeout=400)
        return running.returncode, said

    def begin(self, *arguments, **environment):
        """Type a command; return its process."""
        return subprocess.Popen([sys.executable, str(self.checkout / "morbot_ws/src/jetbot_class/scripts/fleet.py"),
                                 *arguments], env={**self.environment, **environment}, stdin=subprocess.DEVNULL,
                                stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


class Saved:
    """A robot and its laptop as they are now, for tests that each begin with them."""

    def __init__(self, robot, laptop):
        self.robot, self._folder = robot, robot.home.parent
        self._names = [path.name for path in (robot.home, laptop.home, laptop.checkout)]
        self._calls = robot.calls()
        for name in self._names:
            shutil.copytree(self._folder / name, self._folder / "saved" / name, symlinks=True)

    def restore(self):
        """Let both be as they were, and the service and sshd run."""
        pid = self._folder / "saved" / self.robot.home.name / "pid"
        is_other = not accepts(self.robot.port) or (self.robot.home / "pid").read_text() != pid.read_text()
        if is_other:
            self.robot.end_service()
        for name in self._names:
            shutil.rmtree(self._folder / name)
            shutil.copytree(self._folder / "saved" / name, self._folder / name, symlinks=True)
        if is_other:
            self.robot.boot()
            shutil.copy(self.robot.home / "pid", pid)
            (self.robot.home / "calls").write_text("".join(f"{call}\n" for call in self._calls))
        if not accepts(self.robot.ssh_port):
            self.robot.start_sshd()


def make_key(path):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(path)], check=True)


def accepts(port):
    """Return whether a program listens at this port."""
    with socket.socket() as probe:
        return probe.connect_ex(("127.0.0.1", port)) == 0


def wait(condition, explanation=str, timeout=TIMEOUT):
    """Wait until something is so."""
    ends_at = time.monotonic() + timeout
    while not condition():
        assert time.monotonic() < ends_at, explanation()
        time.sleep(0.02)


def small_version(checkout):
    """Fill a checkout with what ./morbot fleet needs, and a service that takes no time to build."""
    for package in CHECKOUT:
        for part in ("src", "scripts", "launch"):
            if (PACKAGES / package / part).exists():
                shutil.copytree(PACKAGES / package / part, checkout / "morbot_ws/src" / package / part,
                                ignore=shutil.ignore_patterns("__pycache__"))
    write(checkout / "morbot", MORBOT)
    write(checkout / "serve.py", SERVE)
    write(checkout / "last_file", "")


def make_world(folder: Path, systemctl=SYSTEMCTL, fill=small_version):
    """Return (robot, laptop). fill: makes the first version in the laptop's checkout."""
    robot = Robot(folder, systemctl)
    try:
        return robot, Laptop(folder, robot, fill)
    except BaseException:
        robot.close()
        raise


def check_cut(robot, laptop, moment):
    """Turn the robot off at a command of an update; return whether there was one: it starts whole, and can be updated.

    moment: the number of the command.
    """
    before = robot.current()
    new = laptop.commit(f"cut at {moment}", news=str(moment))
    robot.cut_at(moment)
    code, said = laptop.fleet("update", "--within", "1")
    was_cut = robot.was_cut()
    assert (code == 1) == was_cut, said
    assert robot.current() in (before, new)
    robot.boot()
    code, said = laptop.fleet("update")
    assert code == 0 and robot.current() == new, said
    assert robot.versions() == {before, new}
    return was_cut
