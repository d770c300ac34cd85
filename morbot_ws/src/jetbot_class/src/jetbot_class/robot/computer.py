"""This computer, as its administrator changes it: files in one step, systemd's units, its name."""

import os
import shutil
import socket
import subprocess
from pathlib import Path
from typing import Iterable, List, NoReturn

from jetbot import JetbotError
from jetbot.text import printable

PUT = 'mkdir -p "${1%/*}"; cat >"$1.new"; chmod 644 "$1.new"; sync "$1.new"; mv "$1.new" "$1"'  # whole, or not at all


class Refused(JetbotError):
    """Why the robot cannot be set up; one sentence."""


def refuse(reason: str, advice: str = "") -> NoReturn:
    """Raise Refused."""
    raise Refused(reason, advice)


class Computer:
    """root: the folder of its files."""

    def __init__(self, root: Path = Path("/")):
        self.root = root

    def require(self) -> None:
        """Raise Refused if no service can be installed here, or not by this user."""
        if os.environ.get("SUDO_USER"):
            refuse("type this without sudo", "It asks for the administrator's password itself.")
        if not (self.root / "run/systemd/system").is_dir():
            refuse("systemd does not run here, so nothing can start with the computer",
                   "In a container: see docs/deploy.md.")
        if os.getuid() and not shutil.which("sudo"):
            refuse("there is no sudo here", "Let an administrator install it: apt install sudo")

    def as_root(self, *command: str, content: str = "", check: bool = True) -> int:
        """Run a command as root with this on its standard input. Raise Refused if it fails and must not."""
        words = [*([] if os.getuid() == 0 else ["sudo"]), *command]
        try:
            code = subprocess.run(words, input=content.encode(), check=False).returncode
        except FileNotFoundError:
            code = 127
        if code and check:
            shown = " ".join(word for word in words if " " not in word)
            refuse(f"this did not succeed, see above: {shown}", "When that is corrected, type the same again.")
        return code

    def put(self, file: str, content: str) -> bool:
        """Write a file in one step; return whether it was another. Raise Refused."""
        path = self.root / file
        if path.is_file() and path.read_text(errors="replace") == content:
            return False
        self.as_root("sh", "-ec", PUT, "put", str(path), content=content)
        return True

    def remove(self, *files: str) -> None:
        """Delete these files, as far as they exist. Raise Refused."""
        found = [str(self.root / file) for file in files if (self.root / file).exists()]
        if found:
            self.as_root("rm", "-f", *found)

    def systemctl(self, *words: str, check: bool = True) -> int:
        """Run systemctl as root."""
        return self.as_root("systemctl", *words, check=check)

    def is_active(self, unit: str) -> bool:
        """Return whether systemd runs a unit, or starts it again."""
        state = ask("systemctl", "is-active", unit)
        return state in ("active", "activating", "reloading", "deactivating")

    def name(self) -> str:
        """Return the host's name."""
        return socket.gethostname()

    def rename(self, new: str, *before: str) -> None:
        """Give the host a name, by which it also knows itself, and no more by those before. Raise Refused."""
        old = self.name()
        self._put_hosts(new)  # both names until it has the new one: sudo looks for its own
        if old != new:
            self.as_root("hostnamectl", "set-hostname", new)
            self.systemctl("try-restart", "avahi-daemon", check=False)
        self._put_hosts(new, old, *before)

    def _put_hosts(self, name: str, *without: str) -> None:
        hosts = self.root / "etc/hosts"
        text = hosts.read_text(errors="replace") if hosts.is_file() else "127.0.0.1 localhost\n"
        self.put("etc/hosts", with_name(text, name, without))


def with_name(hosts: str, name: str, without: Iterable[str]) -> str:
    """Return the text of /etc/hosts in which a name is this computer's, and others are no more."""
    lines = hosts.splitlines()
    own = [number for number, line in enumerate(lines) if line.split()[:1] == ["127.0.1.1"]] or [len(lines)]
    others = [each for line in lines[own[0]:own[0] + 1] for each in line.split()[1:] if each not in (name, *without)]
    lines[own[0]:own[0] + 1] = [" ".join(["127.0.1.1", name, *others])]
    return "\n".join(lines) + "\n"


def ask(*command: str) -> str:
    """Return what a command prints, stripped; "" if there is no such command."""
    try:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=False)
    except FileNotFoundError:
        return ""
    return printable(done.stdout.decode(errors="replace").strip())


def groups_missing(user: str) -> List[str]:
    """Return the groups of the robot's devices that this user is not in."""
    have = ask("id", "-nG", user).split()
    return [group for group in ("i2c", "dialout", "video")
            if group not in have and ask("getent", "group", group)] if os.getuid() else []
