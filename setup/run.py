"""./morbot run and class: run.py WHAT PACKAGE FILE NAME:=VALUE... refuses a mistyped word or a second start.

Then it becomes roslaunch, without its list of all parameters. WHAT: what is started, for the terminal.
"""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C during the imports ends it without a traceback

import os
import re
import sys
from typing import Iterable, List, Optional

import roslaunch.arg_dump
import roslaunch.config
import rospkg

from jetbot.text import closest, printable
from jetbot_ros.contract import COCKPIT_PORT
from jetbot_ros.master import is_reachable, master_uri, require_master, require_name
from jetbot_ros.ports import is_free, processes_on

FILES = ("config", "body", "world")  # arguments that may be a file in the current folder
MASTER = "http://localhost:11311"  # where ROS looks for it
OTHERS_MASTER = (f"The ROS master at {MASTER} is another user's. For one of your own, in each terminal: "
                 "export ROS_MASTER_URI=http://localhost:11411")
NO_NUMBER = re.compile(r"""could not convert string to float: (.*?)\. .*?<param name="(\w+)\"""", re.S)  # roslaunch's
PORTS = range(COCKPIT_PORT, COCKPIT_PORT + 100)  # for the cockpit's page: the first one that no program has


def word_problem(words: Iterable[str], known: Iterable[str]) -> Optional[str]:
    """Return the problem with the first word that is not name:=value with a known name, or None."""
    for word in words:
        name, colon, value = word.partition(":=")
        if name in known and colon or name.startswith("__"):
            continue
        mistyped = re.fullmatch(r"(\w+)(?::=|[=:])(.+)|\w+", word)
        meant = mistyped and closest(mistyped[1] or word, known)
        advice = (f"Did you mean {meant}:={mistyped[2] or 'VALUE'}?" if meant
                  else "An argument is NAME:=VALUE, without spaces, such as linear:=0.2")
        return f"there is no argument {name if colon else word}. {advice}"
    return None


def is_others_master() -> bool:
    """Return whether another user's program has the ROS master's usual port, and no other address was given."""
    port = int(MASTER.rpartition(":")[2])
    return master_uri().rstrip("/") == MASTER and not is_free(port) and not processes_on(port)


def start_problem(nodes: Iterable[str]) -> Optional[str]:
    """Return why these nodes cannot be started now, or None: the ROS master, or one that already runs."""
    if is_others_master():
        return OTHERS_MASTER
    if is_reachable(master_uri()):  # else roslaunch starts a master
        try:
            require_master()
            for name in nodes:
                require_name(name)
        except SystemExit as refusal:
            return str(refusal)
    return None


def whole_path(word: str) -> str:
    """Return a word with the whole path of the file that it names; a node would look for it in ROS's home."""
    name, _, value = word.partition(":=")
    return f"{name}:={os.path.abspath(value)}" if name in FILES and os.path.isfile(value) else word


def problem_of(package: str, file: str, words: List[str]) -> Optional[str]:
    """Return why roslaunch cannot start this file with these words, or None."""
    try:
        path, = roslaunch.rlutil.resolve_launch_arguments([package, file])
        config = roslaunch.config.load_config_default([path], None, assign_machines=False)
        known = {name for each in config.roslaunch_files for name in roslaunch.arg_dump.get_args([each])}
    except rospkg.ResourceNotFound as missing:
        return f"the package {missing.args[0]} is needed to run, and ROS does not find it"
    except roslaunch.RLException as error:
        value = NO_NUMBER.search(str(error))
        return f"{value[2]}:= is a number, and not {value[1]}" if value else str(error)
    required = [node.namespace + node.name for node in config.nodes if node.required]
    return word_problem(words, known) or start_problem(required)


def main(what: str, package: str, file: str, *typed: str) -> None:
    words = list(map(whole_path, typed))
    sys.argv[1:] = words  # roslaunch reads the values of the arguments there
    problem = problem_of(package, file, [word for word in words if not word.startswith("-")])
    if problem:
        sys.exit(f"morbot: {printable(problem)}")
    if "cockpit:=true" in words and not any(word.startswith("cockpit_port:=") for word in words):
        words.append(f"cockpit_port:={next(filter(is_free, PORTS), COCKPIT_PORT)}")
    print(f"morbot: {what}; Ctrl-C ends it", flush=True)
    os.execvp("roslaunch", ["roslaunch", "--no-summary", package, file, *words])


if __name__ == "__main__":
    main(*sys.argv[1:])
