#!/usr/bin/env python3
"""Measures how a robot drives a task: rosrun driving_tasks judge.py TASK."""

import signal
import sys

if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.SIG_DFL)  # while it imports, Ctrl-C prints no traceback

try:
    import contextlib
    from argparse import Namespace
    from pathlib import Path
    from typing import Iterator, List, Optional

    import rospy

    from driving_tasks.arguments import is_single, parse_arguments
    from driving_tasks.report import marks
    from driving_tasks.report.marks import Mark
    from driving_tasks.scoring.tasks import TASKS
    from jetbot import JetbotError, files
    from jetbot.text import printable
    from jetbot_ros.lifecycle import leave
except ImportError as error:
    sys.exit(f"{error}: open a shell with ./morbot shell, and type rosrun driving_tasks judge.py there.")


def main() -> int:
    """Judge what was typed; return the exit code."""
    given = parse_arguments(rospy.myargv()[1:])
    if not given.task:
        print("\n".join(f"{task.name:9} {task.instruction}" for task in TASKS.values()))
        return 0
    for file in filter(None, (given.csv, given.picture)):
        files.check_writable(file)
    judged: List[Mark] = []
    table = marks.Table(given.csv) if given.csv else None
    try:
        with contextlib.closing(judge(given)) as found:  # whatever happens here, the robots get their worlds back
            for mark in found:
                report(mark, given, is_first=not judged)
                judged.append(mark)
                judged.sort(key=lambda mark: given.robot.index(mark.label) if mark.label in given.robot else 0)
                with contextlib.suppress(OSError):  # a full disk ends no round; the last try reports it
                    write(table, judged)
    finally:
        if table and judged:
            write(table, judged)
            show(f"Wrote {table.file}.")
    return 0 if judged and all(mark.result for mark in judged) else 1


def judge(given: Namespace) -> Iterator[Mark]:
    """Return the marks of the drives, each as the drive ends."""
    if given.bag:
        from driving_tasks.sources.bags import judge_bags  # here: each of these takes long to import
        return judge_bags(given.task, given.bag, given.robot[0] if given.robot else None)
    if given.program:
        from driving_tasks.sources.handed_in import judge_programs
        return judge_programs(given.task, given.program, given.config, given.variation)
    from driving_tasks.sources.live import judge_robots
    return judge_robots(given.task, given.robot, given.record)


def write(table: Optional[marks.Table], judged: List[Mark]) -> None:
    """Write the marks so far: a judge that is killed loses none. Raises OSError."""
    if table:
        table.write(marks.COLUMNS, (mark.row for mark in judged))


def report(mark: Mark, given: Namespace, is_first: bool) -> None:
    """Print the mark: sentences if there is only this one, else a row of the table; and draw it."""
    single = is_single(given)
    if single:
        prefix = f"{mark.name}: " if mark.problem and (given.bag or given.program) else ""
        for sentence in mark.sentences:
            show(prefix + sentence)
    else:
        print(marks.to_csv(marks.COLUMNS if is_first else (), [mark.row]), end="", flush=True)
    if mark.result and (single or given.pictures):
        draw(mark, given)


def draw(mark: Mark, given: Namespace) -> None:
    """Draw the picture of a drive; without one, its score still counts."""
    try:
        file = given.picture or picture_file(mark, given)
        if is_single(given):
            show(f"Drawing {file} ...")  # the first picture takes seconds: Matplotlib looks for this computer's fonts
        from driving_tasks.report import drawing
        drawing.draw(mark.result, str(file), mark.note)
    except ImportError:
        show("No picture was drawn. Install what draws it: sudo apt install python3-matplotlib")
    except OSError as error:
        show(f"No picture was drawn: {error}")
    else:
        if is_single(given):
            show(f"Drew {file}.")


def picture_file(mark: Mark, given: Namespace) -> Path:
    """Return the file of a picture whose name was not typed. Raises OSError if it is a link."""
    file = Path(given.pictures, f"{mark.label}.png") if given.pictures else Path(f"{mark.task}.png")
    folder = Path(given.pictures or ".").resolve()
    if file.resolve() != folder / file.relative_to(given.pictures or "."):
        raise OSError(f"{file} is a link")
    file.parent.mkdir(parents=True, exist_ok=True)
    return file


def show(sentence: str) -> None:
    print(printable(sentence), flush=True)


def end(sentence: str, code: int) -> None:
    print(printable(sentence), file=sys.stderr, flush=True)
    leave(code)


if __name__ == "__main__":
    try:
        for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):  # kill and a closed terminal: as Ctrl-C
            signal.signal(signum, signal.default_int_handler)
        leave(main())
    except JetbotError as error:
        end(str(error), 1)
    except OSError as error:
        end(f"{error.filename or 'The output'} cannot be used: {error.strerror or error}.", 1)
    except KeyboardInterrupt:
        end("Cancelled.", 130)
