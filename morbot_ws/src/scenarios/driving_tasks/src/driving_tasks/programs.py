"""Runs pupils' programs, one after the other, and judges how each one drives a simulated robot of its own."""

import contextlib
import os
import shutil
import signal
import sys
import tempfile
from pathlib import Path
from typing import Iterator, Optional

from jetbot.errors import InvalidValue

from .bags import read_config
from .child import FORK, adopt_orphans, end_with_parent
from .contained import end_children
from .marks import Mark
from .tasks import Task
from .trial import DRIVE_TIMEOUT, START_TIMEOUT, try_program
from .walk import Found, find_files, name_below

OTHER_FILES = ("__init__.py", "setup.py")  # of a package, that are no programs
END_TIMEOUT = 20  # s until all processes have ended


def judge_programs(task: Task, path: str, config: str = "") -> Iterator[Mark]:
    """Yield the mark of a program, or of each in a folder. Raises InvalidValue.

    They run with all rights of this user, one after the other, because motion is measured by the clock.
    config: the controller's file of parameters, such as si_units.yaml.
    """
    read_config(config)  # the controller would not start
    root = Path(path).absolute()  # each program runs in a folder of its own
    found = find_files(root, ".py") if root.is_dir() else [Found(root, "" if root.is_file() else "It is not a file.")]
    found = [each for each in found if each.path.name not in OTHER_FILES]
    if not found:
        raise InvalidValue(f"there is no file that ends in .py in {path}")
    for each in found:
        name = name_below(root, each.path)
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
    """Answer with the mark, once nothing of the program is left. This runs in the child."""
    os.setsid()  # what is typed in the terminal goes to the parent alone, which ends this process
    signal.signal(signal.SIGTERM, lambda *_: sys.exit())
    end_with_parent(parent, signal.SIGTERM)
    adopt_orphans()
    mark = None
    try:
        mark = try_program(*arguments)
        signal.signal(signal.SIGTERM, signal.SIG_IGN)  # nothing interrupts the end
    except SystemExit:
        signal.signal(signal.SIGTERM, signal.SIG_IGN)
    finally:
        end_children()
        shutil.rmtree(arguments[-1], ignore_errors=True)
        with contextlib.suppress(OSError):  # the parent has ended
            answer.send(mark)
        os._exit(0)  # rospy's threads have nothing left to do
