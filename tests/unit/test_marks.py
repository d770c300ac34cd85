"""Marks: a table that each spreadsheet reads, and the files of a folder that somebody handed in."""

import csv
import io
import os

import pytest

from driving_tasks import marks, walk
from driving_tasks.samples import Sample
from driving_tasks.score import judge
from driving_tasks.tasks import TASKS
from jetbot.kinematics import Pose

DRIVE = [Sample(time / 50, Pose(min(1.0, max(0.0, time - 50) * 0.006), 0.0, 0.0), 0.3) for time in range(600)]


def test_a_mark_is_a_row_and_a_few_sentences():
    mark = marks.Mark("anna.bag", "metre", judge(TASKS["metre"], DRIVE), source="odometry")
    assert mark.row == ("anna.bag", "metre", "100.0", "3.3", "", "", "odometry")
    assert mark.sentences == ["metre: 100.0 of 100 points in 3.3 s.", "No loss of more than half a point.",
                              "Measured by its odometry, not by the simulator."]
    failed = marks.Mark("ben.bag", "metre", problem="It is empty.")
    assert failed.row == ("ben.bag", "metre", "", "", "", "It is empty.", "")


@pytest.mark.parametrize("name, cell", [
    ("=1+1", "'=1+1"), (" +1", "' +1"), ("-1", "'-1"), ("@x", "'@x"), ("a;=1", "a;'=1"), ("a-1", "a-1"),
    ("Jörg", "Jörg"),
    ('say "a, b"', 'say "a, b"'), ("a\nb\x1b[31m", "a\\nb\\x1b[31m"), (os.fsdecode(b"\xff"), "\\udcff")])
def test_no_name_is_a_formula_or_a_second_line(tmp_path, name, cell):
    marks.write(str(tmp_path / "marks.csv"), ("name", "problem"), [(name, "")])
    content = (tmp_path / "marks.csv").read_bytes()
    assert content.startswith(b"\xef\xbb\xbfname,problem\n")  # the byte order mark: spreadsheets take it for UTF-8
    assert list(csv.reader(io.StringIO(content.decode("utf-8-sig")))) == [["name", "problem"], [cell, ""]]


def names(found, root):
    return [(str(each.path.relative_to(root)), each.problem) for each in found]


def test_files_of_a_folder_in_order(tmp_path):
    for name in ("b.bag", "a/2.bag", "a/1.bag", "notes.txt", "c.bag/d.bag"):
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).touch()
    (tmp_path / "link.bag").symlink_to("/dev/zero")
    (tmp_path / "links").symlink_to("/")
    os.mkfifo(tmp_path / "pipe.bag")
    assert names(walk.find_files(tmp_path, ".bag"), tmp_path) == [
        ("a/1.bag", ""), ("a/2.bag", ""), ("b.bag", ""), ("c.bag/d.bag", ""),
        ("link.bag", "It is a link: hand in the file itself."), ("pipe.bag", "It is not a regular file.")]


def test_too_many_files_and_folders(tmp_path, monkeypatch):
    monkeypatch.setattr(walk, "MAX_FILES", 2)
    (tmp_path / "/".join("deep folders within folders, one in another".split())).mkdir(parents=True)
    (tmp_path / "deep/folders/within/folders,/one/in/another/last").mkdir()
    (tmp_path / "deep/x.bag").touch()
    found = names(walk.find_files(tmp_path, ".bag"), tmp_path)
    assert found == [("deep/folders/within/folders,/one/in/another/last", "It is more than 8 folders deep."),
                     ("deep/x.bag", "")]
    for name in "yz":
        (tmp_path / f"{name}.bag").touch()
    assert names(walk.find_files(tmp_path, ".bag"), tmp_path)[2:] == [
        (".", "It holds more than 2 files: only these are judged.")]
    monkeypatch.setattr(walk, "MAX_ENTRIES", 3)
    assert [each.problem for each in walk.find_files(tmp_path, ".bag")] == [
        "There are more than 3 files and folders: the others are left out."]


def test_a_folder_that_cannot_be_opened(tmp_path):
    assert walk.find_files(tmp_path / "gone", ".bag") == [
        (tmp_path / "gone", "It cannot be opened: No such file or directory.")]
