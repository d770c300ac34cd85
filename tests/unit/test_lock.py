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


def test_a_frozen_program_still_holds_its_board(holder, place):
    os.kill(holder.pid, signal.SIGSTOP)
    with pytest.raises(JetbotError):
        lock_board(place, 0x60)


def test_the_lock_ends_with_its_process(holder, place):
    holder.kill()
    holder.wait()
    lock_board(place, 0x60).close()


@pytest.mark.parametrize("kind", ["fake bus", "device"])
def test_a_board_has_one_lock_whatever_path_leads_to_it(folder, port, tmp_path, kind):
    target, prefix = (folder, "fake:") if kind == "fake bus" else (port[1], "")
    (tmp_path / "link").symlink_to(target)
    with lock_board(f"{prefix}{target}", 0x60), pytest.raises(JetbotError):
        lock_board(f"{prefix}{tmp_path / 'link'}", 0x60)


def test_other_boards_are_free(place, tmp_path):
    other, long = f"fake:{tmp_path}/other", f"fake:{tmp_path}/{'A' * 200}"
    boards = (place, 0x60), (place, 0x5D), (other, 0x60), (f"{long}/1", 0x60), (f"{long}/2", 0x60)
    for lock in [lock_board(*board) for board in boards]:
        lock.close()
