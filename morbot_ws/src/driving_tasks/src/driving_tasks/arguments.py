"""The command line of judge.py."""

import argparse
import contextlib
import re
import sys
from pathlib import Path
from typing import List

from jetbot.text import closest, enumeration, printable

from .scoring.tasks import TASKS


def parse_arguments(words: List[str]) -> argparse.Namespace:
    """Return what was typed; end the program with one sentence if it cannot be meant so."""
    parser = _Parser(prog="judge.py", description="Measures how a robot drives a task.", allow_abbrev=False,
                     epilog="Without TASK: lists the tasks. Without --bag and --program: judges the simulated robot "
                            "that drives now.")
    parser.add_argument("task", nargs="?", type=_task, metavar="TASK")
    parser.add_argument("--robot", nargs="+", type=lambda name: name.strip("/"), default=[], metavar="NAME",
                        help="the robots' namespaces (default: the only one there is)")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--bag", metavar="PATH",
                        help="judge a rosbag, or each in a folder; nothing in it is executed")
    source.add_argument("--program", metavar="PATH",
                        help="run a program, or each in a folder, and judge its drive")
    parser.add_argument("--config", default="", metavar="FILE",
                        help="units of the programs' commands: a YAML file such as si_units.yaml")
    parser.add_argument("--variation", type=_share, default=0.0, metavar="0..1",
                        help="of programs: how much their robot differs from the model, the same for each")
    parser.add_argument("--picture", type=_file(".png"), metavar="FILE.png", help="of one drive (default: TASK.png)")
    parser.add_argument("--pictures", metavar="FOLDER", help="a picture of each drive goes here")
    parser.add_argument("--csv", type=_file(".csv"), metavar="FILE.csv",
                        help="the marks; those of several drives are printed, too")
    parser.add_argument("--record", type=_file(".bag"), metavar="FILE.bag", help="record what is judged now")
    given = parser.parse_args(words)
    _check(parser, given)
    return given


def is_single(given: argparse.Namespace) -> bool:
    """Return whether one drive is judged: its result is written as sentences, not as a table."""
    return len(given.robot) < 2 and not Path(given.bag or given.program or "?").is_dir()


class _Parser(argparse.ArgumentParser):
    def error(self, message):
        """End the program with one sentence or two."""
        sentence = re.sub(r"^argument (?:TASK: )?", "", message)
        advice = "" if sentence.endswith((".", "?")) else ". See judge.py --help."
        sys.exit(printable(sentence[0].upper() + sentence[1:] + advice))


def _task(text):
    if text in TASKS:
        return TASKS[text]
    meant = closest(text, TASKS)
    advice = f"Did you mean {meant}?" if meant else f"The tasks are {enumeration(list(TASKS))}."
    raise argparse.ArgumentTypeError(f"There is no task {text}. {advice}")


def _share(text):
    with contextlib.suppress(ValueError):
        if 0 <= float(text) <= 1:
            return float(text)
    raise argparse.ArgumentTypeError(f"It must be from 0 to 1, not {text}.")


def _file(suffix):
    """Return what checks the name of a file: one that is written takes the place of no other kind of file."""
    def check(text):
        if not text.endswith(suffix):
            raise argparse.ArgumentTypeError(f"Its name must end in {suffix}, not {text}.")
        return text
    return check


def _check(parser, given):
    """End the program for options that contradict each other, or that lack the task."""
    live = not (given.bag or given.program)
    for impossible, reason in (
            (not given.task and any(vars(given).values()),
             f"the task is missing. The tasks are {enumeration(list(TASKS))}."),
            (given.record and not live, "--record is for a robot that drives now."),
            ((given.config or given.variation) and not given.program,
             "--config and --variation belong to --program: any other drive has those of its robot."),
            (given.picture and not is_single(given), "--picture is for one drive; for several, use --pictures FOLDER."),
            (given.robot and (given.program or given.bag and len(given.robot) > 1),
             "--robot names one robot of a bag, and none of a program.")):
        if impossible:
            parser.error(reason)
