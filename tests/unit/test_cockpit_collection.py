"""The pictures that a page collects: who may, where they are kept, and what a disk refuses."""

import errno
import os
import threading

import pytest
from cockpit_control import ADA, BOB, TEACHER, Cockpit

from jetbot.wait import wait_until
from jetbot_cockpit.notices import say
from jetbot_cockpit.session import collection as collections
from jetbot_cockpit.session.collection import Collection
from jetbot_cockpit.session.feed import Picture
from jetbot_cockpit.session.protocol import Message

WITHIN = 10.0  # s
FREE, DELETE = Message("save", "/red", label="free"), Message("delete", "/red")


@pytest.fixture
def folder(tmp_path):
    return tmp_path / "pictures"


@pytest.fixture
def cockpit(folder):
    """Ada drives red; each robot has a picture."""
    cockpit = Cockpit(str(folder))
    cockpit.cameras.pictures = {name: Picture(name.encode(), 0.0, 0.0) for name in ("/red", "/blue")}
    assert cockpit.push(ADA) is None
    cockpit.lift(ADA)
    return cockpit


def wait_for(collection, robot="/red", **wanted):
    assert wait_until(lambda: wanted.items() <= collection.state(robot).items(), WITHIN), collection.state(robot)


def kept(folder):
    return {file.relative_to(folder).as_posix(): file.read_bytes() for file in folder.rglob("*") if file.is_file()}


def test_the_driver_keeps_pictures_with_a_count_and_deletes_them_and_nothing_else(cockpit, folder):
    for number, label in enumerate(("free", "free", "blocked")):
        cockpit.cameras.pictures["/red"] = Picture(b"/red", number, number)
        assert cockpit.do(ADA, Message("save", "/red", label=label)) is None
    wait_for(cockpit.collection, free=2, blocked=1)
    assert kept(folder) == dict.fromkeys(
        ["red/free/0001.jpg", "red/free/0002.jpg", "red/blocked/0001.jpg"], b"/red")
    assert cockpit.control.state()["robots"]["/red"]["pictures"] == {"free": 2, "blocked": 1, "problem": None}
    (folder / "red/free/notes.txt").write_bytes(b"mine")
    assert cockpit.do(ADA, DELETE) is None
    wait_for(cockpit.collection, free=0, blocked=0)
    assert kept(folder) == {"red/free/notes.txt": b"mine"}


def test_a_picture_is_kept_once(cockpit, folder):
    for label in "free", "free", "blocked":
        assert cockpit.do(ADA, Message("save", "/red", label=label)) is None
    cockpit.cameras.pictures["/red"] = Picture(b"next", 1.0, 1.0)
    assert cockpit.do(ADA, FREE) is None
    wait_for(cockpit.collection, free=2)
    assert kept(folder) == {"red/free/0001.jpg": b"/red", "red/free/0002.jpg": b"next"}


def test_a_robot_named_robot_shares_no_folder_with_one_without_a_name(folder):
    collection = Collection(str(folder))
    for name in "/", "/robot":
        collection.save(name, "free", name.encode())
        wait_for(collection, name, free=1)
    collection.delete("/robot")
    wait_for(collection, "/robot", free=0)
    assert kept(folder) == {"robot/free/0001.jpg": b"/"}


@pytest.mark.parametrize("link", ["red", "red/blocked"])
def test_no_link_leads_out_of_the_folder(folder, tmp_path, link):
    mine = tmp_path / "mine/blocked/0001.jpg"
    mine.parent.mkdir(parents=True)
    mine.write_bytes(b"mine")
    (folder / link).parent.mkdir(parents=True)
    (folder / link).symlink_to(mine.parent if link.endswith("blocked") else tmp_path / "mine")
    collection = Collection(str(folder))
    collection.delete("/red")
    wait_for(collection, problem=say("picture_not_kept", problem="This folder is a link", file=folder / link).fields())
    collection.save("/red", "blocked", b"x")
    collection.save("/blue", "free", b"x")
    wait_for(collection, "/blue", free=1)
    assert kept(tmp_path / "mine") == {"blocked/0001.jpg": b"mine"}


@pytest.mark.parametrize("message", [FREE, DELETE], ids=["save", "delete"])
def test_who_does_not_drive_the_robot_collects_none_of_its_pictures(cockpit, folder, message):
    assert cockpit.do(ADA, FREE) is None
    wait_for(cockpit.collection, free=1)
    for client in BOB, TEACHER:
        assert cockpit.do(client, message)["text"] == "Only who drives red collects its pictures. Drive it first."
    assert len(kept(folder)) == 1


def test_who_goes_on_collecting_stays_the_driver(cockpit):
    for _ in range(3):
        cockpit.wait(4)
        assert cockpit.do(ADA, FREE) is None
    cockpit.wait(6)
    assert "Drive it first" in cockpit.do(ADA, FREE)["text"]


def test_without_a_picture_none_is_kept(cockpit, folder):
    cockpit.cameras.pictures = {}
    assert cockpit.do(ADA, FREE)["text"] == "There is no picture."
    assert not folder.exists()


def test_nothing_is_kept_where_that_is_switched_off():
    assert Collection(False).save("/red", "free", b"x") == say("no_pictures_kept")
    assert Collection(False).state("/red") is None


def test_what_an_earlier_start_has_kept_is_counted_and_no_picture_is_replaced(folder):
    (folder / "robot/free").mkdir(parents=True)
    for number in 1, 3:
        (folder / f"robot/free/000{number}.jpg").write_bytes(b"old")
    collection = Collection(str(folder))
    wait_for(collection, "/", free=2)
    for _ in range(2):
        collection.save("/", "free", b"new")
    wait_for(collection, "/", free=4)
    assert [kept(folder)[f"robot/free/000{number}.jpg"] for number in (1, 2, 3, 4)] == [b"old", b"new", b"old", b"new"]


def test_the_pictures_of_a_whole_class_are_counted(folder):
    robots = [f"/jetbot_{number:02}" for number in range(1, 31)]
    for robot in robots:
        (folder / f"{robot[1:]}/blocked").mkdir(parents=True)
        (folder / f"{robot[1:]}/blocked/0001.jpg").write_bytes(b"x")
    collection = Collection(str(folder))
    assert wait_until(lambda: all((collection.state(robot) or {}).get("blocked") == 1 for robot in robots), WITHIN)


def test_a_name_with_slashes_stays_one_folder_below_the_pictures(folder):
    collection = Collection(str(folder))
    collection.save("/class/jetbot_07", "blocked", b"x")
    wait_for(collection, "/class/jetbot_07", blocked=1)
    assert list(kept(folder)) == ["class.jetbot_07/blocked/0001.jpg"]


def test_a_label_has_room_for_so_many(folder, monkeypatch):
    monkeypatch.setattr(collections, "MAX_PICTURES", 2)
    collection = Collection(str(folder))
    for _ in range(3):
        collection.save("/red", "free", b"x")
    wait_for(collection, free=2, problem=say("free_full", count=2).fields())


def test_a_full_disk_gives_one_sentence_and_loses_nothing(folder, monkeypatch):
    collection = Collection(str(folder))
    collection.save("/red", "free", b"x")
    wait_for(collection, free=1)

    def fsync(_):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))
    with monkeypatch.context() as full:
        full.setattr(os, "fsync", fsync)
        collection.save("/red", "free", b"y")
        wait_for(collection, free=1, problem=say("picture_not_kept", problem="No space left on device",
                                               file=folder / "red/free/0002.jpg").fields())
    assert kept(folder) == {"red/free/0001.jpg": b"x"}
    collection.save("/red", "free", b"z")
    wait_for(collection, free=2, problem=None)


def test_a_disk_that_hangs_delays_nobody(folder, monkeypatch):
    collection = Collection(str(folder))
    wait_for(collection, free=0)
    hangs, resumes = threading.Event(), threading.Event()
    monkeypatch.setattr(os, "fsync", lambda _: (hangs.set(), resumes.wait(WITHIN)))
    collection.save("/red", "free", b"x")
    assert hangs.wait(WITHIN)
    answers = [collection.save("/red", "free", b"x") for _ in range(collections.MAX_WAITING + 1)]
    assert answers == [None] * collections.MAX_WAITING + [say("pictures_busy")]
    resumes.set()
    wait_for(collection, free=collections.MAX_WAITING + 1)
