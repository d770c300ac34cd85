"""A class's packages are marked, whatever is in them, and nothing of them is executed."""

import os
import time

import pytest

from jetbot_lessons import lessons, marking, package_files
from judged_bags import TRUTH, write
from lesson_package import DRIVE, PACKAGE_XML, SCRIPT, made_package  # noqa: F401  a fixture


def mark(lesson, folder):
    """Return the problem in the row of a folder, without its path."""
    [row] = marking.mark_folders(lesson, [str(folder)])
    assert row.name.isprintable() and row.problem.isprintable() and row.done == ("no" if row.problem else "yes")
    return row.problem.replace(f"{folder}/", "")


def test_package_that_was_handed_in(mine, tmp_path):
    assert mark(7, mine.parent).endswith("has 2 packages: give the folder of one")
    (tmp_path / "ann").mkdir()
    package = mine.rename(tmp_path / "ann/mine")
    assert (mark(7, package), mark(7, package.parent)) == ("", "")
    assert mark(8, package) == ("package.xml does not name jetbot_control_node: "
                                "add <exec_depend>jetbot_control_node</exec_depend> before </package>")
    assert mark(9, package) == ("There is no file metre.bag: record your drive with "
                                "rosrun driving_tasks judge.py metre --record metre.bag")


@pytest.mark.parametrize("topic, problem", [
    (TRUTH, None),
    ("odom", "{bag} is not what the simulator has measured (odometry): record your drive with "
             "rosrun driving_tasks judge.py metre --record {bag}")], ids=["a recorded bag", "odometry"])
def test_a_drive_that_was_handed_in(mine, topic, problem):
    bag = write(str(mine / "metre.bag"), topic)
    assert package_files.check_drive(mine, "metre") == (problem and problem.format(bag=bag))


ENTITIES = "".join(f'<!ENTITY l{n} "{10 * f"&l{n - 1};"}">' for n in range(1, 12))
BOMB = f'<!DOCTYPE l [<!ENTITY l0 "lol">{ENTITIES}]><launch>&l11;</launch>'


@pytest.mark.parametrize("file, content, problem", [
    (DRIVE, SCRIPT + "-" * 900_000 + "1", "Python cannot read drive.py: it is nested too deeply"),
    (DRIVE, SCRIPT + "open('executed', 'w')", ""),
    ("package.xml", BOMB, "package.xml cannot be read: it defines the entity l0: remove <!ENTITY ...>"),
    ("package.xml", PACKAGE_XML.replace("Mine.", "<b>" * 7000 + "</b>" * 7000), "package.xml cannot be read: "),
    (DRIVE, os.mkfifo, "scripts/drive.py is not a file"),
    (DRIVE, lambda file: file.symlink_to("/etc/passwd"), "scripts/drive.py is a link that leads out of the package"),
    ("package.xml", lambda file: file.symlink_to("/dev/zero"), "package.xml is a link that leads out of the package"),
    ("\033[2J\n", lambda folder: folder.symlink_to("/"), r"\x1b[2J\n is a link that leads out of the package"),
    ("CMakeLists.txt", lambda file: None, "There is no CMakeLists.txt in "),
    ("many", lambda folder: [(folder / str(n)).mkdir(parents=True) for n in range(1000)],
     "mine has more than 1,000 files")], ids=lambda value: ascii(value)[:40] if isinstance(value, str) else None)
def test_hostile_folder_gets_a_row_and_is_not_executed(mine, monkeypatch, file, content, problem):
    monkeypatch.chdir(mine)
    place = mine / file
    if place.exists():
        place.unlink()
    content(place) if callable(content) else place.write_text(content)
    if (mine / DRIVE).exists() and not (mine / DRIVE).is_symlink():  # it may lead to a file of root's
        (mine / DRIVE).chmod(0o755)
    found = mark(7, mine).replace(f"{mine.parent}/", "")
    assert found[:len(problem)] == problem and not (mine / "executed").exists()
    assert problem or not found


@pytest.mark.parametrize("happens, reason", [
    (os.abort, "It needs more than "), (lambda: time.sleep(60), "It takes more than 1 s.")])
def test_file_that_ends_or_stops_its_reader_gets_a_row(mine, monkeypatch, happens, reason):
    monkeypatch.setattr(lessons, "LIMITS", lessons.LIMITS._replace(wall_time=1))
    monkeypatch.setattr(package_files, "check_scripts", lambda package: happens())
    assert f" cannot be checked: {reason}" in mark(7, mine)
