"""Checks of the running system: what the ROS master, its nodes and roslaunch report."""

import contextlib
import socket
import time
from pathlib import Path
from threading import Thread
from typing import Callable, Dict, Iterator, List, Optional, Set
from xmlrpc.client import Fault

from jetbot.text import enumeration
from jetbot_ros.master import (
    ALIVE,
    NO_ANSWER,
    address_of,
    ask,
    ask_master,
    condition_of,
    master_uri,
    proxy,
    system_state,
)
from jetbot_ros.processes import command_of

from . import Problem
from .packages import folder

ASK_INTERVAL = 1.0  # s


def check_master(start: str = "roscore") -> Problem:
    """Return the problem, or None if a master runs; ``start`` is the command that starts one."""
    try:
        ask_master("getPid")
    except socket.timeout:
        return (f"The ROS master at {master_uri()} does not answer: continue it (after Ctrl-Z: fg), "
                f"or stop it and start it with {start}")
    except NO_ANSWER:
        return f"No ROS master at {master_uri()}: start one in another terminal with {start}"
    return None


def report_loss(callback: Callable[[str], None]) -> None:
    """In a thread, call back with the problem if a master no longer answers, for which rospy would wait forever."""
    Thread(target=_wait_for_problem, args=[callback], daemon=True).start()


def _wait_for_problem(callback):
    problem = check_master()
    if problem:  # the checks report it
        return
    while not problem:
        time.sleep(ASK_INTERVAL)
        problem = check_master() and check_master()  # a second question: it may have been busy
    callback(problem)


def publishers_of(topic: str) -> List[str]:
    """Return the nodes that publish on a topic; those that have died are among them."""
    return system_state()[0].get(topic, [])


def subscriptions_of(node: str) -> Dict[str, str]:
    """Return the type of each topic to which a node subscribes; nothing if it does not answer."""
    with contextlib.suppress(*NO_ANSWER):
        return dict(ask(proxy(address_of(node)), "getSubscriptions"))
    return {}


def nodes() -> List[str]:
    """Return the names of all nodes with a topic, sorted; those that have died are among them."""
    publishers, subscribers, _ = system_state()
    return sorted({node for names in (*publishers.values(), *subscribers.values()) for node in names})


def is_alive(node: str) -> bool:
    """Return whether a node answers."""
    return condition_of(node) == ALIVE


def belongs(command: List[Path], package: str) -> bool:
    """Return whether the command starts a script of the package: its source, or catkin's copy."""
    home = folder(package).resolve()
    return any(path.parent.name == package or home in path.parents for path in command)


def check_node(name: str, start: str) -> Problem:
    """Return the problem, or None if the node runs; ``start`` is the command that starts it."""
    if is_alive(name):
        return None
    if name in nodes():
        return (f"The node {name} was killed or hangs: start it again with {start}; "
                "if it hangs, stop it first (after Ctrl-Z: fg, then Ctrl-C)")
    return f"There is no node {name}: start it in another terminal with {start}"


def check_no_other_publisher(topic: str, package: Optional[str] = None) -> Problem:
    """Return the problem, or None if only one node of the package publishes on the topic; dead nodes do not count."""
    publishers = publishers_of(topic)
    own = [node for node in publishers if package and belongs(command_of(node), package)]
    for node in publishers:
        if node not in own[:1] and is_alive(node):
            return f"{node} publishes on {topic}: stop it with Ctrl-C in its terminal, then try again"
    return None


def check_commanded(topic: str, fix: str) -> Problem:
    """Return the problem, or None if exactly one running node publishes on the topic; ``fix`` is how to start it."""
    registered = publishers_of(topic)
    alive = list(filter(is_alive, registered))
    if not alive:
        hanging = "".join(f", but {node} was killed or hangs (fg, then Ctrl-C, stops it)" for node in registered)
        return f"Nobody publishes on {topic}{hanging}: {fix}"
    if len(alive) > 1:
        return f"{enumeration(alive)} publish on {topic}: stop all but one of them with Ctrl-C in their terminals"
    return None


def check_publishes(package: str, topic: str, start: str) -> Problem:
    """Return the problem, or None if a node of the package publishes on the topic; ``start`` is how to start it."""
    publishers = system_state()[0]
    own = [node for node in nodes() if belongs(command_of(node), package)]
    if set(own).intersection(publishers.get(topic, ())):
        return None
    if not own:
        hanging = "".join(f"; {node} was killed or hangs (fg, then Ctrl-C, stops it)"
                          for node in publishers.get(topic, ()) if not is_alive(node))
        return (f"No node of {package} runs{hanging}: start it in another terminal with {start}; "
                "if it ends by itself, that terminal shows why")
    others = sorted(name for name, names in publishers.items() if own[0] in names and name != "/rosout")
    if not others:
        return f"{own[0]} has no rospy.Publisher: make one for {topic}, and call its publish in a loop"
    return f"{own[0]} publishes on {' and '.join(others)}, not on {topic}: use that in rospy.Publisher"


def check_launched_together(*packages: str, namespace: str = "") -> Problem:
    """Return the problem, or None if one roslaunch runs nodes of all these packages in the namespace."""
    if any(set(packages) <= running for running in launched(namespace)):
        return None
    return (f"No launch file runs {' and '.join(packages)}: stop what runs, and start it with roslaunch; "
            "if you did so, read its output, and check pkg and type of each <node>")


def launched(namespace: str = "") -> List[Set[str]]:
    """Return for each roslaunch of this master the packages whose nodes it runs in the namespace, or below it."""
    try:
        uris = ask_master("getParam", "/roslaunch/uris").values()
    except (LookupError, AttributeError):  # none, or something else of this name
        return []
    return [set(_packages_of(uri, namespace)) for uri in uris]


def _packages_of(uri: str, namespace: str) -> Iterator[str]:
    """Yield the packages whose nodes the roslaunch at this address runs; nothing once it has ended."""
    with contextlib.suppress(*NO_ANSWER):
        launch = proxy(uri)
        for name, _ in launch.list_processes()[2][0]:
            if not f"/{name}".startswith(f"{namespace}/"):
                continue
            with contextlib.suppress(Fault):  # of the master itself, which is in no package
                yield str(launch.process_info(name)[2]["package"])
