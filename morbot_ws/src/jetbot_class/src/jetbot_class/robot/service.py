"""The robot's service: systemd's units and avahi's file, from those in systemd/, for this user and this robot."""

import getpass
import os
import secrets
from pathlib import Path
from typing import Dict
from xml.sax.saxutils import escape

from jetbot_cockpit.remote.identity import Identity
from jetbot_ros.contract import COCKPIT_PORT

from .computer import Computer, refuse

ROOT = Path(__file__).resolve().parents[6]
CURRENT = "~/.local/share/morbot/current"  # leads to the folder of the version that runs
GUARD, ROBOT = "jetbot-guard.service", "jetbot.service"
UNITS = "etc/systemd/system"
DROP_IN = f"{UNITS}/{ROBOT}.d/morbot.conf"  # this command's mark: first to come, last to go
AVAHI = "etc/avahi/services"
ANNOUNCEMENT = f"{AVAHI}/morbot.service"
PUT_BY_USER = "~/.ros", "~/jetbot_pictures"
XML = """<?xml version="1.0" standalone="no"?>
<!DOCTYPE service-group SYSTEM "avahi-service.dtd">
<service-group>
  <name>{robot}</name>
  <service>
    <type>_morbot._tcp</type>
    <port>{port}</port>
    <txt-record>name={robot}</txt-record>
    <txt-record>class={class_name}</txt-record>
  </service>
</service-group>
"""


def port_of(arguments: Dict[str, str]) -> int:
    """Return the TCP port of the page."""
    typed = arguments.get("cockpit_port", str(COCKPIT_PORT))
    if not (typed.isdecimal() and 0 < int(typed) < 65536):
        refuse(f"cockpit_port:= is a number from 1 to 65535, and not {typed}")
    return int(typed)


def quoted(word: str) -> str:
    """Return a word as systemd reads it in a command."""
    for special, written in (("\\", "\\\\"), ('"', '\\"'), ("%", "%%"), ("$", "$$")):
        word = word.replace(special, written)
    return f'"{word}"'


def files_of(identity: Identity, arguments: Dict[str, str]) -> Dict[str, str]:
    """Return the service's files, by their names below the root, in the order in which they are written."""
    home, folder = Path.home(), Path(CURRENT).expanduser()
    words = [f"robot:={identity.robot}", *(f"{name}:={value}" for name, value in arguments.items())]

    def template(name: str) -> str:
        text = (ROOT / "systemd" / name).read_text()
        for written, meant in (("/home/jetbot/MorBot", folder), ("/home/jetbot/", f"{home}/"),
                               ("User=jetbot\n", f"User={getpass.getuser()}\n")):
            text = text.replace(written, str(meant))
        return text
    drop_in = template(f"{ROBOT}.d/morbot.conf").rstrip()
    return {DROP_IN: " ".join([drop_in, *map(quoted, words)]) + "\n",
            f"{UNITS}/{GUARD}": template(GUARD), f"{UNITS}/{ROBOT}": template(ROBOT),
            ANNOUNCEMENT: XML.format(robot=identity.robot, class_name=escape(identity.class_name),
                                     port=port_of(arguments))}


def check_alone(computer: Computer) -> None:
    """Raise Refused if this computer starts a robot in another way already."""
    if (computer.root / UNITS / ROBOT).exists() and not (computer.root / DROP_IN).exists():
        refuse("this computer starts a robot already, by a service of its own",
               "End that first: sudo systemctl disable --now jetbot jetbot-guard; "
               "sudo rm /etc/systemd/system/jetbot.service")


def link_current() -> None:
    """Let the service start this folder, in one step."""
    link = Path(CURRENT).expanduser()
    link.parent.mkdir(parents=True, exist_ok=True)
    new = link.with_name(f".{secrets.token_hex(8)}.new")
    new.symlink_to(ROOT)
    os.replace(new, link)


def install(computer: Computer, files: Dict[str, str]) -> None:
    """Write the files, and start the service again; now, and with the computer. Raise Refused."""
    for folder in PUT_BY_USER:  # systemd makes only those writable that exist
        Path(folder).expanduser().mkdir(exist_ok=True)
    write(computer, files)
    link_current()
    os.sync()
    computer.systemctl("daemon-reload")
    computer.systemctl("enable", "--quiet", GUARD, ROBOT)
    computer.systemctl("restart", GUARD, ROBOT)


def write(computer: Computer, files: Dict[str, str]) -> bool:
    """Write the files; return whether any was another. Raise Refused."""
    changed = [computer.put(file, content) for file, content in files.items()
               if file != ANNOUNCEMENT or (computer.root / AVAHI).is_dir()]
    return any(changed)


def uninstall(computer: Computer) -> None:
    """Stop the service, and delete its files. Raise Refused."""
    if not (computer.root / DROP_IN).exists():
        return
    computer.remove(ANNOUNCEMENT)
    for unit in (ROBOT, GUARD):  # the guard last: it stops the wheels
        if (computer.root / UNITS / unit).exists():
            computer.systemctl("disable", "--quiet", "--now", unit)
            computer.remove(f"{UNITS}/{unit}")
    computer.remove(DROP_IN)
    computer.as_root("rmdir", "--ignore-fail-on-non-empty", str((computer.root / DROP_IN).parent))
    computer.systemctl("daemon-reload")
