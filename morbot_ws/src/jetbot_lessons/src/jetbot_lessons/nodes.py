"""ROS nodes: what they answer, within a time, and which program each of them is."""

import contextlib
import os
import queue
from pathlib import Path
from threading import Thread
from typing import Any, Callable, List, Optional
from urllib.parse import urlparse
from xmlrpc.client import ServerProxy

import rosgraph

from jetbot_ros.master import NO_ANSWER, proxy
from jetbot_ros.ports import processes_on

CALLER = "/check_lesson"
TIMEOUT = 2.0  # s for a node to answer


def connect(uri: str) -> ServerProxy:
    """Return the node or roslaunch at this address; a call of its methods raises one of NO_ANSWER."""
    return proxy(uri, TIMEOUT)


def answer_in_time(call: Callable[[], Any]) -> Any:
    """Return what a call returns; None if it takes longer than TIMEOUT, also to find a host by its name."""
    answers = queue.Queue()
    Thread(target=lambda: answers.put(call()), daemon=True).start()
    with contextlib.suppress(queue.Empty):
        return answers.get(timeout=TIMEOUT)
    return None


def pid(node: str) -> Optional[int]:
    """Return the process id that the node reports, on its computer; None for a node that does not answer."""
    answer = ask(node, "getPid")
    return answer if isinstance(answer, int) else None


def ask(node: str, method: str) -> Any:
    """Return a node's answer to a call of ROS's slave API; None for a node that does not answer within TIMEOUT."""
    def call():
        with contextlib.suppress(*NO_ANSWER, rosgraph.MasterException):
            code, _, value = getattr(connect(rosgraph.Master(CALLER).lookupNode(node)), method)(CALLER)
            return value if code == 1 else None

    return answer_in_time(call)


def command_of(node: str) -> List[Path]:
    """Return the interpreter and the script of a node on this computer; nothing for another computer's node."""
    with contextlib.suppress(OSError, ValueError, rosgraph.MasterException):
        process = pid(node) and _listener(rosgraph.Master(CALLER).lookupNode(node))
        if process:
            working_folder = (process / "cwd").resolve()
            words = [os.fsdecode(word) for word in (process / "cmdline").read_bytes().split(b"\0")]
            return [(working_folder / word).resolve() for word in words if word and not word.startswith("-")][:2]
    return []


def _listener(uri: str) -> Optional[Path]:
    """Return the folder in /proc of this user's process that listens at the address; a node may report any id."""
    address = urlparse(uri)
    if not rosgraph.network.is_local_address(address.hostname):
        return None
    return next((Path("/proc", str(process)) for process in processes_on(address.port)), None)
