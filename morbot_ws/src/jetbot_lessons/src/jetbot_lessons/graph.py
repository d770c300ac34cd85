"""Checks of the running system: what the ROS master, its nodes and roslaunch report."""

import contextlib
from pathlib import Path
from typing import Dict, Iterator, List, NamedTuple, Optional, Set
from xmlrpc.client import Fault

import rosgraph

from jetbot.text import enumeration

from . import Problem
from .files import folder
from .nodes import CALLER, NO_ANSWER, ask, command_of, connect, pid


class Graph(NamedTuple):
    """The nodes that publish on each topic, and those that subscribe to it."""

    publishers: Dict[str, List[str]]
    subscribers: Dict[str, List[str]]

    @property
    def nodes(self) -> List[str]:
        """The names of all nodes with a topic, sorted."""
        return sorted({node for nodes in (*self.publishers.values(), *self.subscribers.values()) for node in nodes})


def snapshot() -> Graph:
    """Return the present Graph; raise rosgraph.MasterException without a master."""
    publishers, subscribers, _ = rosgraph.Master(CALLER).getSystemState()
    return Graph(dict(publishers), dict(subscribers))


def check_node(name: str, start: str) -> Problem:
    """Return the problem, or None if the node runs; ``start`` is the command that starts it."""
    if pid(name) is not None:
        return None
    nodes = snapshot().nodes
    if name in nodes:
        return (f"The node {name} was killed or hangs: start it again with {start}; "
                "if it hangs, stop it first (after Ctrl-Z: fg, then Ctrl-C)")
    elsewhere = [node for node in nodes if node.endswith(name)]
    if elsewhere:
        return f"{elsewhere[0]} runs in a namespace: start it without one"
    return f"There is no node {name}: start it in another terminal with {start}"


def check_subscribes(node: str, topic: str) -> Problem:
    """Return the problem, or None if the node subscribes to the topic."""
    if node in snapshot().subscribers.get(topic, ()):
        return None
    return f"{node} does not subscribe to {topic}: was it started in a namespace, or was {topic} remapped?"


def check_type(topic: str, wanted: str) -> Problem:
    """Return the problem, or None if all publishers of the topic publish messages of this type."""
    for node in snapshot().publishers.get(topic, ()):
        given = _types(node).get(topic, wanted)
        if given != wanted:
            return (f"{node} publishes {given} on {topic}, not {wanted}: stop it with Ctrl-C in its terminal; "
                    "in a script of your own, pass that type to rospy.Publisher")
    return None


def _types(node: str) -> Dict[str, str]:
    """Return the type of each topic on which the node says it publishes."""
    with contextlib.suppress(TypeError, ValueError):  # no answer, or not a list of pairs
        return dict(ask(node, "getPublications"))
    return {}


def check_no_other_publisher(topic: str, package: Optional[str] = None) -> Problem:
    """Return the problem, or None if only one node of the package publishes on the topic; dead nodes do not count."""
    publishers = snapshot().publishers.get(topic, ())
    own = [node for node in publishers if package and belongs(command_of(node), package)]
    for node in publishers:
        if node not in own[:1] and pid(node) is not None:
            return f"{node} publishes on {topic}: stop it with Ctrl-C in its terminal, then try again"
    return None


def check_commanded(topic: str, fix: str) -> Problem:
    """Return the problem, or None if exactly one running node publishes on the topic; ``fix`` is how to start it."""
    registered = snapshot().publishers.get(topic, ())
    nodes = [node for node in registered if pid(node) is not None]
    if not nodes:
        hanging = "".join(f", but {node} was killed or hangs (fg, then Ctrl-C, stops it)" for node in registered)
        return f"Nobody publishes on {topic}{hanging}: {fix}"
    if len(nodes) > 1:
        return f"{enumeration(nodes)} publish on {topic}: stop all but one of them with Ctrl-C in their terminals"
    return None


def check_publishes(package: str, topic: str, start: str) -> Problem:
    """Return the problem, or None if a node of the package publishes on the topic; ``start`` is how to start it."""
    graph = snapshot()
    own = [node for node in graph.nodes if belongs(command_of(node), package)]
    if set(own).intersection(graph.publishers.get(topic, ())):
        return None
    if not own:
        hanging = "".join(f"; {node} was killed or hangs (fg, then Ctrl-C, stops it)"
                          for node in graph.publishers.get(topic, ()) if pid(node) is None)
        return (f"No node of {package} runs{hanging}: start it in another terminal with {start}; "
                "if it ends by itself, that terminal shows why")
    others = sorted(name for name, nodes in graph.publishers.items() if own[0] in nodes and name != "/rosout")
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
        uris = rosgraph.Master(CALLER).getParam("/roslaunch/uris").values()
    except (rosgraph.MasterError, AttributeError):  # none, or something else of this name
        return []
    return [set(_packages_of(uri, namespace)) for uri in uris]


def _packages_of(uri: str, namespace: str) -> Iterator[str]:
    """Yield the packages whose nodes the roslaunch at this address runs; nothing once it has ended."""
    with contextlib.suppress(*NO_ANSWER):
        launch = connect(uri)
        for name, _ in launch.list_processes()[2][0]:
            if not f"/{name}".startswith(f"{namespace}/"):
                continue
            with contextlib.suppress(Fault):  # of the master itself, which is in no package
                yield str(launch.process_info(name)[2]["package"])


def belongs(command: List[Path], package: str) -> bool:
    """Return whether the command starts a script of the package: its source, or catkin's copy."""
    home = folder(package).resolve()
    return any(path.parent.name == package or home in path.parents for path in command)
