"""A robot's shell by OpenSSH, and git over it; each failure in one sentence."""

import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import List, Optional

from jetbot import JetbotError
from jetbot.text import printable

SCRIPT = Path(__file__).with_name("robot.sh")
REPOSITORY = ".local/share/morbot/repository"
CONNECT_TIMEOUT = 10  # s
LOST = 255            # exit code of ssh itself
CAUSES = {  # what ssh says, and what is wrong
    "host key|HOST IDENTIFICATION": "{host} has another host key than before: it is another computer, or was installed "
                                    "again. If you trust it: ssh-keygen -R {host} -f {hosts}",
    "Connection refused": "{host} has no ssh running: sudo apt install openssh-server, there",
    "Could not resolve": "no computer is called {host} in this network",
    "Permission denied": "{host} refuses the login: is it {login}?",
    "timed out|No route|unreachable": "{host} does not answer",
}


class Failed(JetbotError):
    """Why a robot could not be reached, or did not do what it was asked to; one sentence. Names keep their case."""

    def __str__(self) -> str:
        return self.reason


class Ssh:
    """A connection to one robot, until the end of a ``with``. login: [USER@]HOST; folder: where host keys are kept."""

    def __init__(self, login: str, folder: Path):
        self.login, self.host = login, login.rpartition("@")[2]
        self._hosts = folder / "known_hosts"
        self._options = ["-o", f"ConnectTimeout={CONNECT_TIMEOUT}", "-o", "ServerAliveInterval=5",
                         "-o", "ServerAliveCountMax=3", "-o", "StrictHostKeyChecking=accept-new",
                         "-o", f'UserKnownHostsFile="{self._hosts}"']
        self._sockets: Optional[str] = None

    def __enter__(self) -> "Ssh":
        if not shutil.which("ssh"):
            raise Failed("there is no ssh on this computer: install OpenSSH's client")
        if os.name == "posix":  # one connection for all, so that a password is typed once
            self._sockets = tempfile.mkdtemp(prefix="morbot-", dir="/tmp")  # a short name: sockets' are limited
            self._options += ["-o", "ControlMaster=auto", "-o", "ControlPersist=60",
                              "-o", f"ControlPath={self._sockets}/%C"]
        try:
            self._connect()
        except BaseException:
            self.__exit__()
            raise
        return self

    def __exit__(self, *_: object) -> None:
        if self._sockets:
            subprocess.run(["ssh", *self._options, "-O", "exit", self.login], stderr=subprocess.DEVNULL, check=False)
            shutil.rmtree(self._sockets, ignore_errors=True)

    def _connect(self) -> None:
        done = subprocess.run(["ssh", *self._options, self.login, "true"], stdin=subprocess.DEVNULL,
                              stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False)
        if done.returncode:
            raise Failed(self._cause(done.stderr.decode(errors="replace")))

    def _cause(self, said: str) -> str:
        values = {"host": self.host, "login": self.login, "hosts": shlex.quote(str(self._hosts))}
        known = [cause for pattern, cause in CAUSES.items() if re.search(pattern, said, re.I)]
        last = (said.strip().splitlines() or ["ssh ended"])[-1]
        return known[0].format(**values) if known else f"{self.host}: {printable(last)}"

    def run(self, *step: str, stdin: Optional[bytes] = None) -> None:
        """Run a function of robot.sh there; a person may type sudo's password. stdin: what it reads. Raise Failed."""
        if self.call(*step, stdin=stdin):
            raise Failed(f"it did not succeed on {self.host} (see above)")

    def call(self, *step: str, stdin: Optional[bytes] = None) -> int:
        """Do the same, and return its exit code. Raise Failed if the connection ends."""
        terminal = ["-t"] if stdin is None and sys.stdin.isatty() else []
        command = " ".join(shlex.quote(each) for each in ["sh", "-c", SCRIPT.read_text(), "morbot", *step])
        code = subprocess.run(["ssh", "-q", *terminal, *self._options, self.login, command], input=stdin,
                              stdin=None if terminal or stdin is not None else subprocess.DEVNULL,
                              check=False).returncode
        if code == LOST:
            raise Failed(f"the connection to {self.host} has ended")
        return code

    def push(self, root: Path, commit: str) -> None:
        """Copy a commit into the robot's repository: only what is missing there. Raise Failed."""
        self.run("receive")
        if self._push(root, commit):  # a power cut has damaged it
            self.run("receive", "again")
            if self._push(root, commit):
                raise Failed(f"{self.host}: git could not copy the version (see above)")

    def _push(self, root: Path, commit: str) -> int:
        ssh = " ".join(shlex.quote(each) for each in ["ssh", "-q", *self._options])
        return git(root, "push", "--quiet", f"{self.login}:{REPOSITORY}", f"+{commit}:refs/heads/update",
                   env={**os.environ, "GIT_SSH_COMMAND": ssh, "GIT_SSH_VARIANT": "ssh"}).returncode


def git(root: Path, *arguments: str, **options: object) -> subprocess.CompletedProcess:
    """Run git in a folder. options: of subprocess.run. Raise Failed without git."""
    try:
        return subprocess.run(["git", "-C", str(root), *arguments], check=False, **options)  # type: ignore[call-overload]
    except FileNotFoundError:
        raise Failed("there is no git on this computer: install it") from None


def checkout(root: Path) -> str:
    """Return the commit of this folder, which robots get; say what is not in it. Raise Failed."""
    def ask(*arguments: str) -> List[str]:
        done = git(root, *arguments, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        if done.returncode:
            raise Failed(f"robots get what git knows of {printable(root)}, but: "
                         f"{printable(done.stderr.decode(errors='replace').strip())}")
        return done.stdout.decode(errors="replace").splitlines()
    commit = ask("rev-parse", "HEAD")[0]
    if ask("status", "--porcelain", "--untracked-files=no"):
        print("Note: changes of this folder that are not committed stay here.", flush=True)
    return commit
