"""Whatever a file is, who reads it says so at once, in one sentence; nothing of it is executed, and nothing is lost."""

import importlib
import os
import signal
from pathlib import Path
from typing import Callable, NamedTuple

import pytest

from jetbot import JetbotError, files
from jetbot.text import printable
from jetbot_cockpit.classroom.folder import ClassFolder
from jetbot_control_node import parameters
from jetbot_tools.calibration.settings import output_file
from simulation import simulation_parameters, world_files

AT_ONCE = 20  # s, with room for what other tests do meanwhile
ENTITIES = "".join(f'<!ENTITY l{n} "{10 * f"&l{n - 1};"}">' for n in range(1, 12))
PLACES = {
    "folder": Path.mkdir, "pipe": os.mkfifo, "device": lambda file: file.symlink_to("/dev/zero"),
    "link to nothing": lambda file: file.symlink_to("no/file"),
    "50 GB": lambda file: file.touch() or os.truncate(file, 50 * 10**9)}
CONTENTS = {
    "empty": b"", "no text": b"a: \xff", "zeros": bytes(99), "escape sequence": b"a: \x1b[2J", "100 kB": b"#" * 100_000,
    "nested": b"[" * 1000, "nested, closed": b"[" * 100000 + b"]" * 100000, "a list": b"[1, 2]",
    "code": b"a: !!python/object/apply:os.mkdir [executed]",
    "aliases": b"a: &a [1]\n" + b"".join(b"b%d: &%c [*%c, *%c]\n" % (n, n + 1, n, n) for n in range(97, 121)),
    "entities": f'<!DOCTYPE l [<!ENTITY l0 "lol">{ENTITIES}]><launch>&l11;</launch>'.encode()}
KINDS = {**PLACES, **{name: lambda file, content=content: file.write_bytes(content)
                      for name, content in CONTENTS.items()}}


class Reader(NamedTuple):
    """Returns or raises what is wrong with the ``file`` in a folder. takes: the kinds with which nothing is wrong.

    make: makes what is around the file.
    """

    read: Callable
    file: str = "file.yaml"
    takes: tuple = ()
    make: Callable = lambda *_: None


def read_class(file):
    folder = ClassFolder(str(file.parents[1]), file.parent.name)
    try:
        assert folder.read(file.stem) is None
    except JetbotError as error:
        pytest.fail(f"the class does not start: {error}")
    folder.close()
    return folder.problems[0]


def read_bag(file):
    pytest.importorskip("rosbag")
    from driving_tasks.scoring.tasks import TASKS
    from driving_tasks.sources.bags import judge_bag
    return judge_bag(TASKS["metre"], str(file)).problem


def read_program(file):
    pytest.importorskip("rospy")
    from driving_tasks.scoring.tasks import TASKS
    from driving_tasks.sources.handed_in import judge_programs
    return next(judge_programs(TASKS["metre"], str(file))).problem


def make_package(*arguments):
    pytest.importorskip("catkin_pkg")
    import lesson_package
    lesson_package.make_package(*arguments)


def check(module, name, *more):
    """Return a check of a lesson, of the package mine; check_lesson.py prints the problem like this."""
    def read(_):
        from jetbot_lessons import lessons
        run = getattr(importlib.import_module(f"jetbot_lessons.{module}"), name)
        return printable(lessons.described(run, "mine", *more))
    return read


READERS = {
    "any": Reader(files.read, takes=tuple(CONTENTS)),
    "to be kept": Reader(files.keep, takes=("link to nothing", "50 GB", *CONTENTS)),
    "to be replaced": Reader(files.check_writable, takes=("link to nothing", "50 GB", *CONTENTS)),
    "of a calibration": Reader(lambda file: output_file(file, False), takes=tuple(CONTENTS)),
    "of parameters": Reader(parameters.load),
    "of a body": Reader(lambda file: simulation_parameters.resolve({"body": str(file)})),
    "of a world": Reader(lambda file: world_files.load(str(file))),
    "of a class": Reader(read_class, "7b/program_1.json", ("link to nothing", "a list")),
    "bag": Reader(read_bag, "drive.bag"),
    "program": Reader(read_program, "drive.py", ("50 GB", *CONTENTS)),
    **{name: Reader(read, f"src/mine/{file}", make=make_package) for name, file, read in (
        ("package.xml", "package.xml", check("packages", "check_exists", "make it")),
        ("launch file", "launch/drive.launch", check("package_files", "check_launch_files")),
        ("script", "scripts/drive.py", check("package_files", "check_scripts")),
        ("answer", "lesson_1.txt", check("answers", "check_needed")))},
}


@pytest.fixture(autouse=True)
def at_once():
    """Fail a test that waits."""
    before = signal.signal(signal.SIGALRM, lambda *_: pytest.fail("it waits"))
    signal.alarm(AT_ONCE)
    yield
    signal.alarm(0)
    signal.signal(signal.SIGALRM, before)


def inventory(folder):
    """Return what is in a folder, whatever it is called."""
    return {(each.lstat().st_ino, each.lstat().st_size, each.lstat().st_mtime_ns) for each in folder.rglob("*")
            if each.is_symlink() or not each.is_dir()}


@pytest.mark.parametrize("reader, kind", [
    (reader, kind) for reader, row in READERS.items() for kind in KINDS if kind not in row.takes])
def test_a_hostile_file_is_one_sentence(tmp_path, monkeypatch, reader, kind):
    row = READERS[reader]
    row.make(tmp_path, monkeypatch)
    file = tmp_path / row.file
    file.parent.mkdir(exist_ok=True)
    file.unlink(missing_ok=True)
    monkeypatch.chdir(file.parent)
    KINDS[kind](file)
    before = inventory(tmp_path)
    try:
        problem = row.read(file)
    except (JetbotError, OSError) as error:
        problem = str(error)
    assert isinstance(problem, str) and problem.isprintable() and 10 < len(problem) < 1100
    assert inventory(tmp_path) == before and not Path("executed").exists()
