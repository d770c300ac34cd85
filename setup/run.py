"""./morbot run: roslaunch, which refuses mistyped words and a silent master before it starts anything."""

# ruff: noqa: E402
import signal

signal.signal(signal.SIGINT, signal.SIG_DFL)  # Ctrl-C while the imports run simply ends it; roslaunch handles it later

import os
import re
import socket
import sys
from typing import List, Optional, Sequence, Tuple
from urllib.parse import urlsplit

from jetbot.text import closest, printable
from jetbot.wait import wait_until
from jetbot_ros.launch_arguments import UNREADABLE, argument_problem, launch_files, receivers
from jetbot_ros.master import NO_ANSWER, is_reachable, master_uri, proxy
from jetbot_ros.ports import COCKPIT_PORT, is_free
from jetbot_ros.roslaunch_command import parse

MASTER_TIMEOUT = 5.0  # s for an answer
ENDING_TIMEOUT = 3.0  # s in which a master that was just interrupted has ended
PORTS = range(COCKPIT_PORT, COCKPIT_PORT + 100)  # for the cockpit's page: the first one that no program has


def word_problem(words: List[str]) -> Optional[str]:
    """Return the problem with words that are not name:=value, or None. words: PACKAGE FILE, then what was typed."""
    files = parse(words).files
    if len(files) == 2:
        return None
    # The words that roslaunch takes for files, with the halves of a name:=value that has a space beside its :=
    text = " ".join(word for word in words[2:] if word in files[2:] or re.match(r"\w*:=$|:=", word))
    meant = re.match(r"(\w+)[\s:=]+(\S+)", text)
    names = {name for each in receivers(launch_files(files[:2])) for name in each.arguments}
    name = meant and closest(meant[1], names)
    advice = f"Did you mean {name}:={meant[2]}?" if name else "An argument is name:=value, such as linear:=0.2"
    return f"morbot: there is no argument {text}. {advice}"


def master_problem(port: str) -> Optional[str]:
    """Return the problem that makes roslaunch wait or fail at the ROS master, or None.

    port: of the option -p, "" without it.
    """
    uri = f"http://localhost:{port}" if port else master_uri()
    host = host_of(uri)
    if not host:
        return f"morbot: ROS_MASTER_URI must look like http://localhost:11311, not {uri}"
    if not is_reachable(uri):
        import rosgraph.network
        return None if rosgraph.network.is_local_address(host) else (
            f"morbot: no ROS master at {uri}. Start roscore on that computer; or to drive on this one: "
            "unset ROS_MASTER_URI")
    try:
        if wait_until(lambda: is_master(uri) or not is_reachable(uri), ENDING_TIMEOUT):
            return None
    except socket.timeout:
        return (f"morbot: the ROS master at {uri} does not answer. Is it frozen (Ctrl-Z)? Continue it with fg, "
                "or restart it.")
    return (f"morbot: another program than a ROS master listens at {uri}. End it, or choose another port: "
            "export ROS_MASTER_URI=http://localhost:11399")


def is_master(uri: str) -> bool:
    """Return whether a ROS master listens at this URI; raise socket.timeout if what listens does not answer."""
    try:
        return bool(proxy(uri, MASTER_TIMEOUT).getPid("/morbot"))
    except socket.timeout:
        raise
    except NO_ANSWER:
        return False


def host_of(uri: str) -> Optional[str]:
    """Return the host in a URI, or None if it names no host and port."""
    try:
        return urlsplit(uri).hostname if urlsplit(uri).port else None
    except ValueError:
        return None


def with_whole_path(word: str) -> str:
    """Return a word with the whole path of the file that it names; a node would look for it in ROS's home."""
    name, _, value = word.partition(":=")
    return f"{name}:={os.path.abspath(value)}" if name in ("config", "body") and os.path.isfile(value) else word


def cockpit_port(typed: Sequence[Tuple[str, str]]) -> List[str]:
    """Return the argument that gives the cockpit's page a free port; none if a port was typed."""
    if any(name == "cockpit_port" and value for name, value in typed):
        return []
    return [f"cockpit_port:={next(filter(is_free, PORTS), COCKPIT_PORT)}"]


def main(words: List[str]) -> int:
    words = list(map(with_whole_path, words))
    command = parse(words)
    try:
        problem = word_problem(words)
    except UNREADABLE:  # a broken launch file: roslaunch reports that
        problem = None
    problem = problem or argument_problem(command.files, command.typed) or master_problem(command.port)
    if problem:
        sys.exit(printable(problem))
    from launch import launch  # here: it takes longer to import than all the rest
    return launch([*words, *cockpit_port(command.typed)])


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
