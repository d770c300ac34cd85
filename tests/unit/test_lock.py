"""One program drives a board: the second is refused while the first lives, and only then."""

import os
import signal
import subprocess
import sys

import pytest
from guarded import start

from jetbot import JetbotError
from jetbot.connection import lock_board


@pytest.fixture
def place(folder):
    return f"fake:{folder}"


@pytest.fixture
def holder(folder, place):
    """Another process that holds the lock."""
    code = (f"import sys; from jetbot.connection import lock_board; lock = lock_board({place!r}, 0x60)\n"
            "print('locked', flush=True); sys.stdin.read()")
    with start(folder, code, stdin=subprocess.PIPE, stdout=subprocess.PIPE) as process:
        assert process.stdout.readline() == b"locked\n"
        yield process
        process.kill()


def test_a_second_program_is_refused_with_one_sentence(holder, place):
    for _ in range(2):
        with pytest.raises(JetbotError) as error:
            lock_board(place, 0x60)
        assert str(error.value) == (
            f"Another program ({os.path.basename(sys.executable)}, process {holder.pid}) already drives 0x60 on "
            f"{place}. End that first.")


def test_also_by_another_path(holder, folder, tmp_path):
    (tmp_path / "link").symlink_to(folder)
    with pytest.raises(JetbotError):
        lock_board(f"fake:{tmp_path / 'link'}", 0x60)


def test_a_frozen_program_still_holds_its_board(holder, place):
    os.kill(holder.pid, signal.SIGSTOP)
    with pytest.raises(JetbotError):
        lock_board(place, 0x60)


def test_the_lock_ends_with_its_process(holder, place):
    holder.kill()
    holder.wait()
    lock_board(place, 0x60).close()


def test_other_boards_are_free(holder, place, tmp_path):
    lock_board(place, 0x5d).close()
    lock_board(f"fake:{tmp_path / 'other'}", 0x60).close()


def test_a_device_has_one_lock_whatever_its_name(port, tmp_path):
    (tmp_path / "serial").symlink_to(port[1])
    with lock_board(port[1], None), pytest.raises(JetbotError):
        lock_board(str(tmp_path / "serial"), None)


def test_long_names_are_told_apart(tmp_path):
    long = f"{tmp_path}/{'A' * 200}"
    lock_board(f"{long}/1", None)
    lock_board(f"{long}/2", None).close()
