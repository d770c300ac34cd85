"""The command line of roslaunch. Quick to import, because each start of a robot imports it."""

import argparse
import os
import signal
import sys
from typing import List, NamedTuple, NoReturn

PARENT = os.getppid()
LISTING = {"--nodes", "--files", "--args", "--find-node", "--dump-params", "--ros-args"}  # nothing is started
WITH_VALUE = ("--pid", "-w", "--numworkers", "-t", "--timeout", "--master-logger-level", "--sigint-timeout",
              "--sigterm-timeout", "--run_id")
PROGRAMS = {"roslaunch", "run.py"}  # run.py: of ./morbot run


class Command(NamedTuple):
    """A command line of roslaunch: the launch file, as one or two words, then further ones; what was typed; the port.

    typed: [(name, value)] of the words name:=value; port: of the master, "" if it was not given.
    """

    files: List[str]
    typed: List[tuple]
    port: str


def parse(words: List[str]) -> Command:
    """Return the Command that the words after ``roslaunch`` give."""
    parser = argparse.ArgumentParser(add_help=False)
    parser.add_argument("-p", "--port", default="")
    for name in WITH_VALUE:
        parser.add_argument(name)
    options, rest = parser.parse_known_args(words)
    return Command([word for word in rest if ":=" not in word and (word == "-" or not word.startswith("-"))],
                   [tuple(word.split(":=", 1)) for word in rest if ":=" in word], options.port)


def parent_words() -> List[str]:
    """Return the words after ``roslaunch`` of the parent process; nothing if it starts no node, or /proc hides it."""
    try:
        with open(f"/proc/{PARENT}/cmdline", errors="surrogateescape") as cmdline:
            words = cmdline.read().split("\0")[:-1]
    except OSError:
        return []
    program = next((index for index, word in enumerate(words[:3]) if os.path.basename(word) in PROGRAMS), None)
    return [] if program is None or LISTING.intersection(words) else words[program + 1:]


def end_roslaunch(sentence: object) -> NoReturn:
    """Print the sentence and end this process and its parent, a roslaunch that has not started anything yet.

    Without the signal, roslaunch would print a page of XML.
    """
    from jetbot.text import printable  # here: nearly every start does without
    print(printable(sentence), file=sys.stderr, flush=True)
    if os.getppid() == PARENT:  # else it has ended meanwhile, and another program is the parent
        os.kill(PARENT, signal.SIGTERM)
    sys.exit(1)
