"""``python3 -m jetbot.guard --listen SOCKET``: guard every robot whose JETBOT_GUARD names this socket.

For a guard that nothing ends together with the program that drives: in a container, or a systemd unit, of its own.
"""

import argparse
import os
import signal
import socket
import sys
import time
from pathlib import Path

from . import require_own
from .process import RETRY_INTERVAL, serve


def bind(path: str) -> socket.socket:
    """Return a socket that listens at this path, for this user only. Raise OSError, also if another guard does."""
    if Path(path).is_socket() and not is_in_use(path):
        Path(path).unlink(missing_ok=True)
    listener = socket.socket(socket.AF_UNIX)
    mask = os.umask(0o177)
    listener.bind(path)
    os.umask(mask)
    listener.listen()
    return listener


def is_in_use(path: str) -> bool:
    """Return whether a process listens on this socket."""
    with socket.socket(socket.AF_UNIX) as probe:
        try:
            probe.connect(path)
        except (ConnectionRefusedError, FileNotFoundError):
            return False
        return True


def serve_in_child(listener: socket.socket, connection: socket.socket) -> None:
    """Serve a connection in a process of its own, which ends with it."""
    require_own(connection)
    if os.fork() == 0:
        listener.close()
        serve(connection)


def main() -> None:
    parser = argparse.ArgumentParser(prog="python3 -m jetbot.guard", description=__doc__.partition(":")[2])
    parser.add_argument("--listen", metavar="SOCKET", required=True, help="the path of a unix socket, which is created")
    path = parser.parse_args().listen
    try:
        listener = bind(path)
    except OSError as error:
        sys.exit(f"The guard cannot listen on {path}: {error.strerror}. Does another guard run, or may this user not "
                 "write there?")
    signal.signal(signal.SIGCHLD, signal.SIG_IGN)  # so that the system forgets a child that has ended
    while True:
        try:
            with listener.accept()[0] as connection:
                serve_in_child(listener, connection)
        except OSError:  # out of processes or file descriptors, or another user's
            time.sleep(RETRY_INTERVAL)


if __name__ == "__main__":
    main()
