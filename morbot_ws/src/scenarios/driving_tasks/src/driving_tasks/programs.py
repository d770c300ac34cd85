"""Runs pupils' programs, one after the other, and judges how each one drives a simulated robot of its own."""

import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path
from typing import Iterator, Optional

from jetbot.errors import InvalidValue

from .bags import read_units
from .bounded import FORK
from .contained import adopt_orphans, end_children, end_with_parent
from .marks import Mark
from .tasks import Task
from .trial import DRIVE_TIMEOUT, START_TIMEOUT, try_program
from .walk import Found, find_files

OTHER_FILES = ("__init__.py", "setup.py")  # of a package, that are no programs
END_TIMEOUT = 20  # s until all processes have ended


def judge_programs(task: Task, path: str, config: str = "") -> Iterator[Mark]:
    """Yield the mark of a program, or of each in a folder. Raises InvalidValue.

    They run with all rights of this user. config: the controller's file of parameters, such as si_units.yaml.
    """
    read_units(config)  # the controller would not start
    root = Path(path).absolute()
    found = find_files(root, ".py") if root.is_dir() else [Found(root, "" if root.is_file() else "It is not a file.")]
    found = [each for each in found if each.path.name not in OTHER_FILES]
    if not found:
        raise InvalidValue(f"{path} holds no file that ends in .py")
    for each in found:
        name = str(each.path.relative_to(root)) if each.path != root else root.name
        mark = None if each.problem else _judge(task, name, each.path, config)
        yield mark or Mark(name, task.name, problem=each.problem or "It could not be judged: its judge was ended.")


def _judge(task: Task, name: str, program: Path, config: str) -> Optional[Mark]:
    """Return the mark of a program, or None if the child that runs and judges it gives none."""
    folder = Path(tempfile.mkdtemp(prefix="judge_"))
    pipe, answer = FORK.Pipe(duplex=False)
    child = FORK.Process(target=_work, args=(os.getpid(), answer, (task, name, program, config, folder)))
    child.start()
    answer.close()
    # In steps, so that a judge that was stopped for longer (Ctrl-Z) does not take that for the program's time.
    seconds = START_TIMEOUT + DRIVE_TIMEOUT + task.time_limit + END_TIMEOUT
    try:
        return pipe.recv() if any(pipe.poll(1) for _ in range(round(seconds))) else None
    except EOFError:
        return None
    finally:
        child.terminate()
        child.join(END_TIMEOUT)
        child.kill()
        child.join()
        pipe.close()
        shutil.rmtree(folder, ignore_errors=True)


def _work(parent, answer, arguments):
    """Answer with the mark. This runs in the child, which takes all processes of the program along when it ends."""
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # Ctrl-C goes to the parent, which ends this process
    end_with_parent(parent, signal.SIGTERM)
    adopt_orphans()
    try:
        answer.send(try_program(*arguments))
    finally:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
        end_children()
        os._exit(0)  # rospy's threads have nothing left to do
