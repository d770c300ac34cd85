"""The commands of ./morbot fleet, as a table."""

import argparse
import os
import re
import subprocess
import sys
from typing import Any, Callable, Dict, List, NamedTuple, Tuple

from jetbot import JetbotError
from jetbot.text import enumeration, printable
from jetbot_cockpit.remote.fleet import Entry, Fleet
from jetbot_cockpit.web.handout import open_browser
from jetbot_ros.contract import COCKPIT_PORT
from jetbot_ros.ports import is_free

from ..robot.service import port_of
from ..robot.words import known_arguments, split_arguments
from .asking import Answer, ask
from .classes import check_name, delete, enlist, entry_of, open_class, strike, unused_name
from .install import ROOT, RUNS_WITHIN, set_up, update
from .ssh import Failed, Ssh, checkout
from .table import SHORT, table

HUB = ROOT / "morbot_ws/src/jetbot_cockpit/scripts/hub.py"
CODES = "?codes"  # where the page shows the cards
ADDRESS = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]*(:[0-9]{1,5})?")
LOGIN = re.compile(r"([A-Za-z0-9_][A-Za-z0-9._-]*@)?[A-Za-z0-9][A-Za-z0-9._-]*")  # nothing that ssh takes as an option
ON_ROBOT = "there: ./morbot robot --off --forget"


def show(fleet: Fleet, given: Any) -> int:
    """Print the table; return 1 if a robot is missing."""
    if not fleet.robots:
        print(f"The class {fleet.name} has no robot yet: ./morbot fleet add HOST")
        return 1
    answers = ask(fleet, fleet.robots)
    print(table(answers))
    return 0 if all(answer.is_well() for answer in answers) else 1


def add(fleet: Fleet, given: Any) -> int:
    """Install and name a robot over ssh; with --address, only list it."""
    if given.address:
        check_name(given.host)
        entry = Entry(given.host, matching(ADDRESS, given.address, "an address, HOST or HOST:PORT"))
        login = next((each.login for each in fleet.robots if each.name == given.host), "")
        enlist(fleet, entry._replace(login=entry._replace(login=login, last=entry.authority).ssh))
        print(f"{given.host} is listed at {given.address}. Its key: ./morbot fleet --class {fleet.name} key "
              f"{given.host}")
        return 0
    login = matching(LOGIN, given.host, "a computer, HOST or USER@HOST")
    name = given.name or next((each.name for each in fleet.robots if each.login == login), unused_name(fleet))
    check_name(name)
    typed = split_arguments(given.arguments, known_arguments(ROOT / "morbot_ws/src"))
    port = f":{port_of(typed)}" if typed.get("cockpit_port") else ""
    entry = Entry(name, login.rpartition("@")[2] + port, login)
    check_unused(fleet, entry)
    set_up(fleet, entry, checkout(ROOT), given.arguments, lambda: enlist(fleet, entry))
    print(f"{name} is ready, at http://{entry.authority}/")
    return 0


def matching(pattern: "re.Pattern[str]", text: str, meaning: str) -> str:
    """Return the text. Raise Failed if it is something else."""
    if not pattern.fullmatch(text):
        raise Failed(f"{printable(text)} is not {meaning}")
    return text


def check_unused(fleet: Fleet, entry: Entry) -> None:
    """Raise Failed if another robot has this name, and answers."""
    before = next((each for each in fleet.robots if each.name == entry.name), entry)
    if before.authority != entry.authority:
        there, here = ask(fleet, [before, entry], until=Answer.is_well)
        if not there.problem and here.problem:
            raise Failed(f"{entry.name} is the robot at {before.authority}, which answers: type another --name")


def update_all(fleet: Fleet, given: Any) -> int:
    """Update one robot after the other; those that fail stay as they are, and are named."""
    commit = checkout(ROOT)
    entries = [entry_of(fleet, name) for name in given.names] or fleet.robots
    failed = each_of(entries, lambda entry: update(fleet, entry, commit, given.force, given.within),
                     f"runs {commit[:SHORT]}")
    if failed:
        print(table(ask(fleet, entries)))
    return 1 if failed else 0


def each_of(entries: List[Entry], act: Callable[[Entry], object], done: str) -> List[Entry]:
    """Do something with each robot, and say so; return those with which it failed."""
    failed = []
    for entry in entries:
        print(f"--- {entry.name}", flush=True)
        try:
            act(entry)
            print(f"{entry.name} {done}", flush=True)
        except (JetbotError, OSError) as error:
            failed.append(entry)
            print(f"{entry.name}: {error}", file=sys.stderr, flush=True)
    return failed


def log(fleet: Fleet, given: Any) -> int:
    """Print what a robot's service has logged."""
    entry = entry_of(fleet, given.robot)
    with connected(fleet, entry) as robot:
        return robot.call("log", *(["--follow"] if given.follow else []), "--lines=200")


def connected(fleet: Fleet, entry: Entry) -> Ssh:
    """Return a connection to a robot. Raise Failed if it is only listed."""
    if not entry.login:
        raise Failed(f"{entry.name} is only listed, with no login for ssh")
    return Ssh(entry.ssh, fleet.path.parent)


def hub(fleet: Fleet, given: Any, *opened: str) -> int:
    """Serve the class's page. opened: the arguments of hub.py for the browser."""
    command = [sys.executable, str(HUB), "--class", fleet.name, *(["--lan"] if given.lan else []),
               "--port", str(given.port), *opened]
    if os.name == "posix":
        os.execv(sys.executable, command)  # who ends this ends the hub
    return subprocess.call(command)


def cards(fleet: Fleet, given: Any) -> int:
    """Open the cards in the browser: on the page of the hub that runs, or else of a new one."""
    page = f"http://localhost:{given.port}/{CODES}"
    print(f"The cards: {page}, then Print on paper.", flush=True)
    if is_free(given.port):
        return hub(fleet, given, "--open", CODES)
    open_browser(page)
    return 0


def key(fleet: Fleet, given: Any) -> int:
    """Print the keys that are typed on robots."""
    for name in [given.robot] if given.robot else [entry.name for entry in fleet.robots]:
        check_name(name)
        digits = fleet.key_of(name)
        print(f"{name}  {'-'.join(digits[at:at + 4] for at in range(0, len(digits), 4))}")
    return 0


def remove(fleet: Fleet, given: Any) -> int:
    """Take a robot from the list."""
    strike(fleet, entry_of(fleet, given.robot).name)
    print(f"{given.robot} is no longer listed, and its key is void. To free it from the class, type {ON_ROBOT}")
    return 0


def asked(question: str) -> str:
    """Return what a person answers, or ""."""
    try:
        return input(question).strip() if sys.stdin.isatty() else ""
    except EOFError:
        return ""


def forget(fleet: Fleet, given: Any) -> int:
    """Delete the class on each robot, then here, once its name is typed."""
    question = (f"This deletes the key, the codes and all programs of the class {fleet.name}, here and on "
                f"{len(fleet.robots)} robots. To delete them, type {fleet.name}: ")
    if not given.yes and asked(question) != fleet.name:
        raise Failed("nothing is deleted; without a terminal, add --yes")
    def on_robot(entry: Entry) -> None:
        with connected(fleet, entry) as robot:
            robot.run("off")
        strike(fleet, entry.name)
    failed = each_of(list(fleet.robots), on_robot, "has forgotten the class")
    if failed:
        names = enumeration([entry.name for entry in failed])
        print(f"The class {fleet.name} stays here too, as it is still on {names}. Type this again later; or type "
              f"{ON_ROBOT}, and here: ./morbot fleet remove NAME", file=sys.stderr)
        return 1
    delete(fleet)
    print(f"Deleted {fleet.path.parent}: the class {fleet.name}, and its key.")
    return 0


class Command(NamedTuple):
    """does: what to call; meaning: for the help; arguments: of add_argument; makes: whether the class may be new."""

    does: Callable[[Fleet, Any], int]
    meaning: str
    arguments: Tuple[Tuple[str, Dict[str, Any]], ...] = ()
    makes: bool = False


ROBOT = ("robot", {"metavar": "NAME"})
HUB_OPTIONS = (
    ("--lan", {"action": "store_true", "help": "for other computers in the network too"}),
    ("--port", {"type": int, "default": COCKPIT_PORT, "help": "TCP port (default: %(default)s)"}))
COMMANDS = {
    "": Command(show, "print the table"),
    "add": Command(add, "install and name a robot over ssh, and list it", (
        ("host", {"metavar": "HOST", "help": "[USER@]HOST; with --address, a robot's name"}),
        ("arguments", {"metavar": "NAME:=VALUE", "nargs": "*", "help": "for the robot, such as board:=sparkfun"}),
        ("--name", {"help": "of the robot (default: the first that is free, as jetbot_01)"}),
        ("--address", {"metavar": "HOST[:PORT]", "help": "only list the robot that is there"})), makes=True),
    "update": Command(update_all, "let robots run this folder's version", (
        ("names", {"metavar": "NAME", "nargs": "*", "help": "which (default: all)"}),
        ("--force", {"action": "store_true", "help": "also while somebody drives"}),
        ("--within", {"type": float, "default": RUNS_WITHIN, "metavar": "SECONDS",
                      "help": "until a robot has to answer with it (default: %(default)g)"}))),
    "log": Command(log, "print a robot's log", (
        ROBOT, ("-f", {"dest": "follow", "action": "store_true", "help": "and go on"}))),
    "hub": Command(hub, "serve the page of the class", HUB_OPTIONS),
    "cards": Command(cards, "open a card for each robot in the browser, to print", HUB_OPTIONS),
    "key": Command(key, "print robots' keys, to be typed at ./morbot robot", (
        ("robot", {"metavar": "NAME", "nargs": "?"}),), makes=True),
    "remove": Command(remove, "take a robot from the list", (ROBOT,)),
    "forget": Command(forget, "delete the class on all robots, and here", (
        ("--yes", {"action": "store_true", "help": "without a question"}),)),
}


class Parser(argparse.ArgumentParser):
    """One sentence for what is typed wrong."""

    def error(self, message: str) -> None:
        self.exit(2, f"morbot: {printable(message)}; see ./morbot fleet --help\n")


def parser() -> Parser:
    """Return the parser of the table."""
    made = Parser(prog="./morbot fleet", description="A class of real robots, from the teacher's computer.",
                  allow_abbrev=False)
    class_name = {"dest": "class_name", "metavar": "CLASS", "help": "may be left out if there is one only"}
    made.add_argument("--class", default="", **class_name)
    made.set_defaults(command="")
    commands = made.add_subparsers(metavar="COMMAND", parser_class=Parser)
    for name, command in COMMANDS.items():
        if name:
            each = commands.add_parser(name, help=command.meaning, description=command.meaning, allow_abbrev=False)
            each.set_defaults(command=name)
            each.add_argument("--class", default=argparse.SUPPRESS, **class_name)
            for argument, options in command.arguments:
                each.add_argument(argument, **options)
    return made


def read(arguments: List[str]) -> argparse.Namespace:
    """Return what was typed. A robot's arguments may follow an option, where argparse takes no more words."""
    made = parser()
    given, rest = made.parse_known_args(arguments)
    options = [each for each in rest if given.command != "add" or each.startswith("-")]
    if options:
        made.error(f"unrecognized arguments: {' '.join(options)}")
    if rest:
        given.arguments += rest
    return given


def main(arguments: List[str]) -> int:
    """Do what was typed; return the exit code."""
    given = read(arguments)
    command = COMMANDS[given.command]
    try:
        return command.does(open_class(given.class_name, command.makes), given)
    except (JetbotError, OSError) as error:
        print(f"morbot: {error}", file=sys.stderr)
        return 1
