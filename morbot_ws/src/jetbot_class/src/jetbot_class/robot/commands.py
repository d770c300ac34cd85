"""./morbot robot: names this robot, changes it, shows what it is, and undoes all."""

import argparse
import getpass
import os
import socket
import subprocess
import time
from pathlib import Path
from typing import Dict, List, Optional

from jetbot.text import printable
from jetbot_cockpit.classroom import folder as classes
from jetbot_cockpit.classroom.place import FOLDER
from jetbot_cockpit.remote import identity as identities
from jetbot_cockpit.remote.identity import Identity
from jetbot_ros.ports import is_free

from . import memory, service
from .computer import Computer, ask, groups_missing, refuse
from .words import check_names, checked_key, known_arguments, read_arguments, typed_key

MASTER_PORT = 11311
READY_TIMEOUT = 90.0  # s until the page answers: a Raspberry Pi 3 needs 40
POLL_INTERVAL = 0.2   # s
DOCTORS = "board", "i2c_bus", "i2c_address", "port"  # the arguments that are the doctor's too
TEST = """{robot} of the class {class_name} runs now, and starts with the computer.
Test it on a box, wheels in the air:
1. Open {address} on a phone in the same network; addresses with the code: sudo journalctl -u jetbot | grep '#'
2. Drive forward on the pad: both wheels turn forward. If not: sudo systemctl stop jetbot; {folder}/morbot calibrate
3. Lift the finger, then also switch the phone's Wi-Fi off while you drive: both wheels stop.
4. Drive, and type on the robot: sudo systemctl kill -s KILL jetbot. The wheels stop, and the page comes back.
5. Switch the robot off and on: the page comes back by itself, and no wheel turns."""


def parser() -> argparse.ArgumentParser:
    """Return the parser of the command line."""
    made = argparse.ArgumentParser(prog="./morbot robot", description="Makes this computer a robot of a class.",
                                   allow_abbrev=False)
    made.error = lambda message: refuse(printable(message))  # type: ignore[method-assign]
    made.add_argument("words", nargs="*", metavar="NAME | ARGUMENT:=VALUE",
                      help="the robot's name, such as jetbot_07; arguments of jetbot_controller.launch, which are kept")
    made.add_argument("--class", dest="class_name", metavar="CLASS", help="the class's name, such as 7b")
    made.add_argument("--key-file", type=Path, metavar="FILE", help="file with the robot's own key")
    made.add_argument("--off", action="store_true", help="undo all; what the class has kept stays")
    made.add_argument("--files", action="store_true", help="only write the service's files again, after an update")
    made.add_argument("--forget", action="store_true", help="with --off: delete what the class has kept here, too")
    return made


def main(arguments: List[str], computer: Optional[Computer] = None) -> int:
    """Do what was typed; return the exit code. Raise JetbotError, OSError."""
    given = parser().parse_intermixed_args(arguments)
    computer = computer or Computer()
    if given.forget and not given.off:
        refuse("--forget goes with --off", "It deletes what the class has kept on this robot.")
    if not (given.off or given.files or given.words or given.class_name or given.key_file):
        return show(computer)
    with memory.alone():
        if given.off:
            return off(computer, given.forget)
        return rewrite(computer) if given.files else name(computer, given)


def name(computer: Computer, given: argparse.Namespace) -> int:
    """Make this computer the robot that was typed, or change it."""
    computer.require()
    before, remembered = known_identity(), memory.load()
    typed = [word for word in given.words if ":=" in word]
    names = [word for word in given.words if ":=" not in word] or ([before.robot] if before else [])
    if len(names) != 1:
        refuse("a robot has one name", "Such as: ./morbot robot jetbot_07 --class 7b")
    robot, class_name = names[0], given.class_name or (before.class_name if before else "")
    check_names(robot, class_name)
    added = read_arguments(typed, known_arguments(service.ROOT / "morbot_ws/src"))
    kept = {key: value for key, value in {**remembered.arguments, **added}.items() if value}
    service.check_alone(computer)
    check_ports(computer, service.port_of(kept))
    identity = Identity(robot, class_name, key_for(given, robot, before, class_name))
    build()
    groups = groups_missing(getpass.getuser())
    memory.Memory(kept, remembered.host or computer.name(), tuple(dict.fromkeys([*remembered.groups, *groups]))).save()
    for group in groups:
        computer.as_root("usermod", "-aG", group, getpass.getuser())
    identities.write(identity)
    computer.rename(host_of(robot), remembered.host)
    service.install(computer, service.files_of(identity, kept))
    return report(computer, identity, kept)


def rewrite(computer: Computer) -> int:
    """Let systemd know the service's files of this folder's version; the service goes on."""
    identity = identities.read() or refuse("this computer is no robot of a class")
    computer.require()
    if service.write(computer, service.files_of(identity, memory.load().arguments)):
        computer.systemctl("daemon-reload")
    return 0


def known_identity() -> Optional[Identity]:
    """Return what this computer is, or None: also if its file is damaged, which is about to be replaced or deleted."""
    try:
        return identities.read()
    except identities.InvalidValue:
        return None


def host_of(robot: str) -> str:
    """Return the host's name for a robot's; a host's has no _."""
    return robot.lower().replace("_", "-").strip("-")


def check_ports(computer: Computer, port: int) -> None:
    """Raise Refused if another program than the service has a port that it needs."""
    if computer.is_active(service.ROBOT):
        return
    if not is_free(MASTER_PORT):
        refuse(f"a ROS master runs here already, at port {MASTER_PORT}", "End what started it, then type this again.")
    if not is_free(port):
        refuse(f"another program has port {port}, which the page needs",
               f"End it, or add another port: cockpit_port:={port + 1}")


def key_for(given: argparse.Namespace, robot: str, before: Optional[Identity], class_name: str) -> str:
    """Return the robot's own key. Raise Refused."""
    known = before.key if before and (before.robot, before.class_name) == (robot, class_name) else ""
    if given.key_file:
        try:
            key = checked_key(given.key_file.read_text(errors="replace"), robot)
        except OSError as error:
            refuse(f"{given.key_file} cannot be read: {error.strerror}")
    else:
        key = known if known and os.isatty(0) else typed_key(robot)
    return key or known or refuse(f"the key of {robot} is missing",
                                  f"On the teacher's computer: ./morbot fleet key {robot}")


def build() -> None:
    """Install what is missing on this computer itself, and build this folder. Raise Refused."""
    environment = {key: value for key, value in os.environ.items() if key not in ("PYTHONPATH", "MORBOT")}
    for step in ("install", "setup"):  # install refuses where only a container has ROS
        if subprocess.run([str(service.ROOT / "morbot"), step], env=environment, stdin=subprocess.DEVNULL,
                          check=False).returncode:
            refuse("this folder could not be built, see above", "Then type the same again.")
    if not (service.ROOT / "morbot_ws/devel/env.sh").is_file():
        refuse(f"you may not write to {service.ROOT}", "Copy this folder into your home.")


def report(computer: Computer, identity: Identity, arguments: Dict[str, str]) -> int:
    """Wait until the page answers, run the doctor, and print what to test. Raise Refused."""
    print("morbot: starting", flush=True)
    port = service.port_of(arguments)
    end = time.monotonic() + READY_TIMEOUT
    while not answers(port):
        if time.monotonic() > end:
            refuse(f"{identity.robot} is installed, but its page does not answer",
                   "This says why: sudo journalctl -u jetbot -n 20")
        time.sleep(POLL_INTERVAL)
    options = [f"{key}:={value}" for key, value in arguments.items() if key in DOCTORS]
    doctor = subprocess.run([str(service.ROOT / "morbot"), "doctor", *options], check=False).returncode
    addresses = [f"http://{host}:{port}" for host in (f"{computer.name()}.local", *ask("hostname", "-I").split())
                 if ":" not in host]
    print(TEST.format(robot=identity.robot, class_name=identity.class_name, address=" or ".join(addresses[:2]),
                      folder=service.CURRENT))
    if not (computer.root / service.AVAHI).is_dir():
        print("Other computers do not find it by its name: sudo apt install avahi-daemon, then type the same again; "
              "or list its address on the teacher's computer.")
    if doctor:
        print("The doctor found a fault, see above: correct it first.")
    return 0


def answers(port: int) -> bool:
    """Return whether the page takes connections."""
    try:
        socket.create_connection(("127.0.0.1", port), 1).close()
    except OSError:
        return False
    return True


def show(computer: Computer) -> int:
    """Print what this robot is; return 1 if it is none, or does not run."""
    identity = identities.read()
    if not identity:
        print("This computer is no robot of a class. To make it one: ./morbot robot jetbot_07 --class 7b")
        return 1
    remembered, link = memory.load(), Path(service.CURRENT).expanduser()
    runs = computer.is_active(service.ROBOT)
    words = " ".join(f"{key}:={value}" for key, value in remembered.arguments.items())
    folder = os.path.realpath(link)
    for label, value in (("robot", identity.robot), ("class", identity.class_name),
                         ("page", f"http://{computer.name()}.local:{service.port_of(remembered.arguments)}"),
                         ("arguments", words or "none"), ("folder", folder), ("runs", "yes" if runs else "no")):
        print(f"{label + ':':<11}{printable(value)}")
    if not os.path.isfile(f"{folder}/morbot_ws/devel/env.sh"):
        print("The folder is gone or not built. In the folder that is to run, type: ./morbot robot "
              f"{identity.robot} --class {identity.class_name}")
        return 1
    return 0 if runs else 1


def off(computer: Computer, forget: bool) -> int:
    """Undo all; it may have been done in part."""
    computer.require()
    service.check_alone(computer)
    identity, remembered = known_identity(), memory.load()
    service.uninstall(computer)
    named = host_of(identity.robot) if identity else computer.name()
    if remembered.host and computer.name() in (named, remembered.host):
        computer.rename(remembered.host, named)
    for group in remembered.groups:
        computer.as_root("gpasswd", "-d", getpass.getuser(), group, check=False)
    if forget:
        forget_class(identity.class_name) if identity else name_classes()
    Path(identities.FILE).expanduser().unlink(missing_ok=True)
    memory.forget()
    Path(service.CURRENT).expanduser().unlink(missing_ok=True)
    print("This computer is no robot of a class any more, and starts none.")
    return 0


def forget_class(class_name: str) -> None:
    """Delete what the class has kept here. Raise Refused, OSError."""
    try:
        count = classes.forget(FOLDER, class_name)
    except classes.Busy:
        refuse(f"a cockpit runs with the class {class_name}", "End it, then type the same again.")
    if count:
        print(f"Deleted {count} files with the codes, names, programs and best scores of the class {class_name}.")


def name_classes() -> None:
    """Print how to delete what classes have kept here, for a computer that does not know its own any more."""
    for file in sorted(Path(FOLDER).expanduser().glob("*/class.json")):
        name = printable(file.parent.name)
        print(f"To delete what the class {name} has kept here, type: ./morbot forget {name}")
