"""A robot that ./morbot fleet reaches: a real sshd, a home of its own, and a cockpit's server; and a laptop."""

import json
import os
import shutil
import subprocess
import threading
from pathlib import Path

from hub_world import Robot as Cockpit

from jetbot.wait import wait_until
from jetbot_class.fleet import commands, install
from jetbot_cockpit.remote.identity import Identity
from jetbot_cockpit.web import hub_socket
from processes import end, free_port, start
from web_client import listens

ROOT = Path(__file__).resolve().parents[2]
COMMANDS = ("git", "tar", "mkdir", "ln", "mv", "touch", "sync", "rm", "readlink", "df", "flock", "cat", "systemctl")
STATE = {"status": "stopped", "state": "stopped", "driver": None}
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
        echo "$2 $4" >"$HOME/identity"
        ln -sfn "$here" "$HOME/.local/share/morbot/current"
        systemctl restart ;;
esac
"""
ORDER = "echo {order} >{folder}/orders && read -r done <{folder}/done"  # to Robot's thread, until it has obeyed
SYSTEMCTL = f"""#!/bin/sh
echo "systemctl $*" >>"$HOME/calls"
{ORDER.replace("{order}", "restart")}
"""
# Everything of the robot's side ends here, at the command that "cut" counts down to: its switch was turned off.
COUNTED = f"""#!/bin/sh
if [ -e "$HOME/cut" ]; then
    exec 8>"$HOME/counts"  # those of a pipe one after the other
    /usr/bin/flock 8
    left=$(($(/bin/cat "$HOME/cut") - 1))
    echo $left >"$HOME/cut"
    if [ $left -le 0 ]; then
        /bin/rm "$HOME/cut"
        {ORDER.replace("{order}", "off")}
        kill -9 0
    fi
    exec 8>&-
fi
exec {{command}} "$@"
"""
SSHD = """Port {port}
ListenAddress 127.0.0.1
HostKey {folder}/host_key
AuthorizedKeysFile {folder}/id.pub
PermitRootLogin yes
StrictModes no
UsePAM no
PidFile none
# The shell of this computer's user reads no settings of that user.
SetEnv HOME={folder}/robot
ForceCommand {folder}/login
"""


def write(path, text, mode=0o755):
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    path.chmod(mode)
    return path


class Robot:
    """Its home, its sshd, and its service: the server of a cockpit, in a thread that obeys systemctl."""

    def __init__(self, folder, systemctl=SYSTEMCTL):
        self.home, self.port, self.ssh_port = folder / "robot", free_port(), free_port()
        self._folder, self._sshd, self._cockpit = folder, None, None
        self.home.mkdir()
        self.says()
        service = write(folder / "systemctl", systemctl.format(folder=folder, port=self.port, master=free_port()))
        for name in COMMANDS:
            real = service if name == "systemctl" else "/bin/true" if name == "sync" else shutil.which(name)
            write(folder / "commands" / name, COUNTED.format(folder=folder, command=real))
        write(folder / "commands/journalctl", '#!/bin/sh\necho "journalctl $*"\n')
        write(folder / "commands/sudo", '#!/bin/sh\nexec "$@"\n')  # where the tests are a user's
        write(folder / "login", f'#!/bin/sh\nexport HOME={self.home} PATH={folder}/commands:/usr/bin:/bin\ncd\n'
                                'exec sh -c "$SSH_ORIGINAL_COMMAND"\n')
        make_key(folder / "host_key")
        for name in "orders", "done":
            os.mkfifo(folder / name)
        self._systemd = threading.Thread(target=self._obey, daemon=True)
        self._systemd.start()
        self.start_sshd()

    def start_sshd(self):
        config = write(self._folder / "sshd_config", SSHD.format(port=self.ssh_port, folder=self._folder))
        self._sshd = start([*OWN_RUN, "/usr/sbin/sshd", "-D", "-e", "-f", str(config)], self._folder / "sshd.log")
        assert wait_until(lambda: listens(self.ssh_port), TIMEOUT), self._sshd.log.read_text()

    def stop_sshd(self):
        end([self._sshd])

    def _obey(self):
        for order in iter((self._folder / "orders").read_text, "end"):
            (self.boot if order == "restart\n" else self.switch_off)()
            (self._folder / "done").write_text("done\n")

    def switch_off(self):
        if self._cockpit:
            self._cockpit.server.end()
            self._cockpit = None

    def boot(self):
        """Start what starts with the computer."""
        self.switch_off()
        version = (self.morbot / "current").resolve()
        if not (version / "does_not_start").exists():
            hub_socket.VERSION = version.name
            name, class_name = (self.home / "identity").read_text().split()
            key = (self.home / "key").read_text()
            self._cockpit = Cockpit(Identity(name, class_name, key), port=self.port)
            state = self._cockpit.control.state()
            row, = state["robots"].values()
            self._cockpit.control.state = lambda: {**state, "robots": {f"/{name}": {**row, **self._said()}}}

    def says(self, **state):
        """Let its cockpit say this."""
        (self.home / "state").write_text(json.dumps({**STATE, **state}))

    def _said(self):
        return json.loads((self.home / "state").read_text())

    def cut_at(self, number):
        """Turn it off at the command with this number from now on."""
        (self.home / "cut").write_text(str(number))

    def was_cut(self):
        return not (self.home / "cut").exists()

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
        (self._folder / "orders").write_text("end")
        self._systemd.join()
        self.switch_off()


class Laptop:
    """A checkout with commits of its own, and ./morbot fleet from there, in this process."""

    def __init__(self, folder, robot, fill, patch):
        self.home, self.checkout = folder / "laptop", folder / "checkout"
        self.home.mkdir()
        make_key(folder / "id")
        self.public_key = (folder / "id.pub").read_text().split()[1]
        config = write(folder / "ssh_config", f"Port {robot.ssh_port}\nIdentityFile {folder}/id\nIdentitiesOnly yes\n"
                                              "BatchMode yes\n", 0o600)
        self._ssh_log = folder / "ssh_arguments"
        write(folder / "bin/ssh", f'#!/bin/sh\necho "$*" >>{self._ssh_log}\n'
                                  f'exec {shutil.which("ssh")} -F {config} "$@"\n')
        patch.setenv("HOME", str(self.home))
        patch.setenv("PATH", f"{folder}/bin", prepend=os.pathsep)
        for module in commands, install:
            patch.setattr(module, "ROOT", self.checkout)
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

    def ssh_arguments(self):
        """Return what ssh was given at all of its starts, without the dashes of keys that people type."""
        return self._ssh_log.read_text().replace("-", "")


class World:
    """A robot and a laptop. patch: for the environment of ./morbot fleet; fill: makes the first version."""

    def __init__(self, folder, patch, systemctl=SYSTEMCTL, fill=None):
        self._folder, self.robot = folder, Robot(folder, systemctl)
        try:
            self.laptop = Laptop(folder, self.robot, fill or small_version, patch)
        except BaseException:
            self.close()
            raise

    def copy(self, source, to):
        """Copy both computers between the folders "." and "saved"."""
        for name in "robot", "laptop", "checkout":
            shutil.rmtree(self._folder / to / name, ignore_errors=True)
            shutil.copytree(self._folder / source / name, self._folder / to / name, symlinks=True)

    def restore(self):
        """Let both be as they were saved, and the service and sshd run."""
        self.robot.switch_off()
        self.copy("saved", ".")
        self.robot.boot()
        if not listens(self.robot.ssh_port):
            self.robot.start_sshd()

    def close(self):
        self.robot.close()


def make_key(path):
    subprocess.run(["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", str(path)], check=True)


def small_version(checkout):
    """Fill a checkout with what ./morbot fleet needs, and nothing that takes time to build."""
    write(checkout / "morbot", MORBOT)
    write(checkout / "last_file", "")
    (checkout / "morbot_ws").mkdir()
    (checkout / "morbot_ws/src").symlink_to(ROOT / "morbot_ws/src")  # the arguments that a robot may be given


def check_cut(world, moment):
    """Turn the robot off at a command of an update; return whether there was one: it starts whole, and can be updated.

    moment: the number of the command.
    """
    robot, laptop = world.robot, world.laptop
    before = robot.current()
    new = laptop.commit(f"cut at {moment}", news=str(moment))
    robot.cut_at(moment)
    code = commands.main(["update", "--within", "1"])
    was_cut = robot.was_cut()
    assert (code == 1) == was_cut
    assert robot.current() in (before, new)
    (robot.home / "cut").unlink(missing_ok=True)
    robot.boot()
    assert commands.main(["update"]) == 0 and robot.current() == new
    assert robot.versions() == {before, new}
    return was_cut
