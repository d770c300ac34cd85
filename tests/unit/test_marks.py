"""Marks: a table that each spreadsheet reads, and the files of a folder that somebody handed in."""

import csv
import io
import os

import pytest

from driving_tasks.report import marks
from driving_tasks.scoring.recorder import Sample
from driving_tasks.scoring.score import judge
from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.folders import find_files
from jetbot import InvalidValue
from jetbot.kinematics import Pose

DRIVE = [Sample(time / 50, Pose(min(1.0, max(0.0, time - 50) * 0.006), 0.0, 0.0), 0.3) for time in range(600)]


def test_a_mark_is_a_row_and_a_few_sentences():
    mark = marks.Mark("anna.bag", "metre", judge(TASKS["metre"], DRIVE), source="odometry")
    assert mark.row == ("", "anna.bag", "metre", "100.0", "3.3", "", "", "odometry")
    assert mark.sentences == ["metre: 100.0 of 100 points in 3.3 s.", "No loss of more than half a point.",
                              "Measured by its odometry, not by the simulator."]
    failed = marks.Mark("ben.bag", "metre", problem="It is empty.")
    assert failed.row == ("", "ben.bag", "metre", "", "", "", "It is empty.", "")
    assert marks.Mark("Ada", "metre", robot="jetbot_07").row[:3] == ("jetbot_07", "Ada", "metre")


@pytest.mark.parametrize("name, cell", [
    ("=1+1", "'=1+1"), (" +1", "' +1"), ("a;-@1", "a;'-@1"), ("a-1", "a-1"), ('"; "＝1', '";\' "＝1'), ("Jörg", "Jörg"),
    ('say "a, b"', 'say "a, b"'), ("a\nb\x1b[31m", "a\\nb\\x1b[31m"), (os.fsdecode(b"\xff"), "\\udcff")])
def test_no_name_is_a_formula_or_a_second_line(tmp_path, name, cell):
    marks.Table(str(tmp_path / "marks.csv")).write(("name", "problem"), [(name, "")])
    content = (tmp_path / "marks.csv").read_bytes()
    assert content.startswith(b"\xef\xbb\xbfname,problem\n")  # the byte order mark: spreadsheets take it for UTF-8
    assert list(csv.reader(io.StringIO(content.decode("utf-8-sig")))) == [["name", "problem"], [cell, ""]]


@pytest.mark.parametrize("separator", [",", ";", "\t"])
@pytest.mark.parametrize("name", [
    "=cmd|'/c calc'!A1", ";\"=cmd|'/c calc'!A1", '";"@1', ',"+1', 'a,-1', "\t=1", '"\t=1', '";;=1', "x\r=1"])
def test_no_name_is_a_formula_whatever_separates_cells(name, separator):
    row = marks.to_csv((), [("jetbot_01", name, "metre", "9.5")])
    cells = next(csv.reader([row], delimiter=separator))
    assert not [cell for cell in cells if cell.strip(' "')[:1] in tuple("=+-@")]


def test_files_of_a_folder_in_order(tmp_path):
    for name in ("b.bag", "a/2.bag", "a/1.bag", "notes.txt", "c.bag/d.bag", "c.bag/setup.bag"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "link.bag").symlink_to("/dev/zero")
    (tmp_path / "links.bag").symlink_to("/")
    os.mkfifo(tmp_path / "pipe.bag")
    link = "It is a link: hand in the file itself."
    assert [(file.name, file.problem) for file in find_files(tmp_path, ".bag", without=("setup.bag",))] == [
        ("a/1.bag", ""), ("a/2.bag", ""), ("b.bag", ""), ("c.bag/d.bag", ""),
        ("link.bag", link), ("links.bag", link), ("pipe.bag", "It is not a regular file.")]


def test_a_folder_that_is_too_deep_too_large_or_empty(tmp_path):
    deep = tmp_path / "/".join("abcdefgh")
    deep.mkdir(parents=True)
    with pytest.raises(InvalidValue, match="There is no file that ends in .bag in "):
        find_files(tmp_path / "a/b/c", ".bag")
    assert [(file.path, file.problem) for file in find_files(tmp_path, ".bag")] == [
        (deep, "It is more than 8 folders deep.")]
    for number in range(1000):
        (tmp_path / f"{number}.bag").touch()
    *found, last = find_files(tmp_path, ".bag")
    assert len(found) == 1000 and last.problem == "It holds more than 1,000 files: only these are judged."


def test_a_second_round_goes_into_a_file_of_its_own(tmp_path):
    file = tmp_path / "metre.csv"
    tables = [marks.Table(str(file)) for _ in range(3)]
    for table in tables:
        table.write(("name",), [("first",)])
        table.write(("name",), [("first",), ("second",)])
    assert [table.file for table in tables] == [
        str(tmp_path / name) for name in ("metre.csv", "metre_2.csv", "metre_3.csv")]
    assert file.read_text("utf-8-sig") == "name\nfirst\nsecond\n"
