"""Files that a person names: a file that is replaced is never lost, and reading one waits for nothing."""

import os
import sys

import pytest

from jetbot import files

OLD, NEW = b"old\n", b"new\n" * 10_000


@pytest.fixture
def file(tmp_path):
    file = tmp_path / "jetbot.yaml"
    file.write_bytes(OLD)
    return file


def calibrate(file, content=NEW):
    """Do what calibrate.py does with its file."""
    files.keep(file)
    files.replace(file, content)


def during(action, observe):
    """Return what ``observe`` returns around each call of a function in C: what a kill there leaves behind."""
    seen = []

    def profile(frame, event, function):
        if event.startswith("c_"):
            seen.append(observe())

    sys.setprofile(profile)
    try:
        action()
    finally:
        sys.setprofile(None)
    return seen


def test_killed_at_any_call_the_old_file_or_the_new_one_is_there(file):
    kept = file.with_name("jetbot.yaml.1")
    seen = during(lambda: calibrate(file), lambda: (file.read_bytes(), kept.exists() and kept.read_bytes()))
    assert {content for content, _ in seen} == {OLD, NEW}
    assert {copy for content, copy in seen if content == NEW} == {OLD}
    assert len(seen) > 50


def test_every_older_file_is_kept(file):
    for content in (b"second", b"third"):
        calibrate(file, content)
    assert {each.name: each.read_bytes() for each in file.parent.iterdir()} == {
        "jetbot.yaml": b"third", "jetbot.yaml.1": OLD, "jetbot.yaml.2": b"second"}


def test_a_link_stays_and_its_file_is_replaced(file, tmp_path):
    (tmp_path / "elsewhere").mkdir()
    target = file.rename(tmp_path / "elsewhere/robot.yaml")
    file.symlink_to("elsewhere/robot.yaml")
    calibrate(file)
    assert file.is_symlink() and target.read_bytes() == NEW
    assert files.read(f"{target}.1") == OLD


def test_a_link_that_leads_to_no_file_yet(file, tmp_path):
    file.unlink()
    file.symlink_to("later.yaml")
    assert files.keep(file) is None
    files.replace(file, NEW)
    assert file.is_symlink() and (tmp_path / "later.yaml").read_bytes() == NEW


def test_permissions_are_kept(file):
    file.chmod(0o640)
    files.replace(file, NEW)
    assert file.stat().st_mode & 0o777 == 0o640


@pytest.mark.parametrize("exists", [True, False])
def test_nobody_else_reads_a_secret_at_any_moment(file, exists):
    if not exists:
        file.unlink()

    def readable():
        return [each.name for each in file.parent.iterdir() if each.stat().st_mode & 0o077 and each.read_bytes() != OLD]

    seen = during(lambda: files.replace_secret(file, NEW), readable)
    assert len(seen) > 20 and not any(seen)
    assert (file.stat().st_mode & 0o777, file.read_bytes()) == (0o600, NEW)


def test_a_full_disk_changes_nothing(file, monkeypatch):
    monkeypatch.setattr(os, "fsync", lambda descriptor: os.write(os.open("/dev/full", os.O_WRONLY), b"x"))
    with pytest.raises(OSError, match="No space left on device"):
        files.replace(file, NEW)
    assert {each.name: each.read_bytes() for each in file.parent.iterdir()} == {"jetbot.yaml": OLD}


def test_whether_a_file_can_be_written_is_known_before_and_leaves_nothing(file):
    files.check_writable(file)
    files.check_writable(file.with_name("new.yaml"))
    with pytest.raises(FileNotFoundError, match="nosuch/jetbot.yaml"):
        files.check_writable(file.parent / "nosuch/jetbot.yaml")
    assert os.listdir(file.parent) == ["jetbot.yaml"]


@pytest.mark.parametrize("module, folder", [
    ("src/mine/src/mine/parameters.py", "src/mine/config"),
    ("install/lib/python3/dist-packages/mine/parameters.py", "install/share/mine/config"),
])
def test_what_a_package_ships_is_found_in_its_source_and_where_it_is_installed(tmp_path, module, folder):
    (tmp_path / folder).mkdir(parents=True)
    assert files.shipped(tmp_path / module, "mine", "config") == tmp_path / folder
