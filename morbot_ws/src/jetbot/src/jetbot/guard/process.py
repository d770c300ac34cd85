"""The guard itself: stops the wheels when the process that drives them ends or hangs.

The two are connected by a socket: the system closes it when the driving process ends, however it ends. Unless that
process has reported that the wheels are stopped, the guard then stops them.
"""

import contextlib
import json
import os
import select
import signal
import socket
import sys
import threading
import time
from pathlib import Path
from typing import Optional

from .. import fake
from ..boards import Board, find_board
from ..connection import stop_board

STOPPED = b"s"            # the driving process has stopped the wheels, and needs no guard any more
HEARTBEAT = b"h"          # it does not hang
PING = b"p"               # it asks for an answer only
ANSWER = b"."             # of the guard, to every message and when it has started
EOF = b""                 # the process at the other end has ended
HEARTBEAT_TIMEOUT = 1.0   # s after a heartbeat until the driving process counts as hung, unless another one comes
RETRY_FOR = 600.0         # s to keep trying when the board does not answer
RETRY_INTERVAL = 0.2      # s


def serve(connection: socket.socket) -> None:
    """Guard the robot at the other end of a connection, then end this process.

    The first line names its board, place and I2C address, as JSON.
    """
    try:
        with connection.makefile("rb", buffering=0) as stream:  # no buffer: what follows the line are messages
            board, place, address = json.loads(stream.readline())
        device = fake.folder_of(place) or place
        if device.startswith("/") and not os.access(device, os.R_OK | os.W_OK):
            connection.send(f"it may not use {device}".encode())
        else:
            guard(connection, find_board(board, address), place)
    finally:
        os._exit(0)  # at once: a thread that ``report`` has started may never end


def guard(connection: socket.socket, board: Board, place: str) -> None:
    """Stop the wheels when the driving process at the other end of the connection ends, and while it hangs.

    place: the ``connection.locate`` the board.
    """
    prepare()
    answer(connection)
    deadline = failure = None  # a program need not send heartbeats; once it has, it must continue
    while True:
        message = read_message(connection, deadline)
        if message == EOF:
            stop(board, place)
            return
        if message is None:
            failure = try_to_stop(board, place, reported=failure)
            deadline = time.monotonic() + RETRY_INTERVAL if failure else None
            continue
        if STOPPED in message:
            return
        if HEARTBEAT in message:
            deadline, failure = time.monotonic() + HEARTBEAT_TIMEOUT, None
        answer(connection)


def prepare() -> None:
    """Outlive what ends other processes of the robot."""
    for signum in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(signum, signal.SIG_IGN)
    with contextlib.suppress(OSError):  # a container may have no /proc, or a read-only one
        Path("/proc/self/comm").write_text("jetbot_guard")  # so that killall python3 leaves it alive


def read_message(connection: socket.socket, deadline: Optional[float]) -> Optional[bytes]:
    """Return the messages that have arrived; EOF once the driving process has ended; None after the deadline.

    deadline: a monotonic time in seconds, or None.
    """
    timeout = None if deadline is None else max(0.0, deadline - time.monotonic())
    if not select.select([connection], [], [], timeout)[0]:
        return None
    try:
        return connection.recv(4096)
    except OSError:  # it has ended before it read the last answer
        return EOF


def answer(connection: socket.socket) -> None:
    """Report to the driving process that its guard is up, without waiting for it."""
    with contextlib.suppress(OSError):
        connection.send(ANSWER, socket.MSG_DONTWAIT)


def stop(board: Board, place: str) -> None:
    """Stop the wheels. If the board does not answer, try for ``RETRY_FOR`` seconds."""
    start, failure = time.monotonic(), None
    while time.monotonic() - start < RETRY_FOR:
        failure = try_to_stop(board, place, reported=failure)
        if failure is None:
            return
        time.sleep(RETRY_INTERVAL)


def try_to_stop(board: Board, place: str, reported: Optional[Exception]) -> Optional[Exception]:
    """Stop the wheels; return what has failed, or None. It is reported, unless another failure has been before."""
    try:
        stop_board(board, place)
    except Exception as failure:  # not only a BusError: whatever has failed, the wheels may still turn
        if reported is None:
            report(f"jetbot: the wheels may still turn: {getattr(failure, 'reason', failure)}")
        return failure
    return None


def report(sentence: str) -> None:
    """Print to stderr from a thread of its own, which waits if nobody reads: a full pipe, a terminal after Ctrl-S."""
    with contextlib.suppress(RuntimeError):  # the system has no thread left
        threading.Thread(target=print, args=[sentence], kwargs={"file": sys.stderr, "flush": True}, daemon=True).start()
