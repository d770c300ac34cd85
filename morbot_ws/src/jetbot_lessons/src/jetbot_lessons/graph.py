"""Checks of the running system: what the ROS master, its nodes and roslaunch say of themselves."""

import contextlib
from http.client import HTTPException
from pathlib import Path
from typing import NamedTuple
from xmlrpc.client import Error, Fault, ServerProxy, Transport

import rosgraph

from .files import folder

CALLER = "/check_lesson"
PATIENCE = 2.0  # seconds for a node to answer
NO_ANSWER = (OSError, HTTPException, Error)  # what comes of a node that hangs or is gone


class ImpatientTransport(Transport):
    """Gives up on a node that hangs."""

    def make_connection(self, host):
        connection = super().make_connection(host)
        connection.timeout = PATIENCE
        return connection


class Graph(NamedTuple):
    """What the master knows of the topics."""

    publishers: dict   # topic: names of nodes
    subscribers: dict  # topic: names of nodes

    @property
    def nodes(self):
        """The names of all nodes with a topic."""
        return {node for nodes in (*self.publishers.values(), *self.subscribers.values()) for node in nodes}


def look():
    """The Graph now."""
    master = rosgraph.Master(CALLER)
    publishers, subscribers, _ = master.getSystemState()
    return Graph(dict(publishers), dict(subscribers))


def master_up(start):
    """Whether there is a master; start: the command that starts one."""
    if rosgraph.is_master_online():
        return None
    return f"No ROS master at {rosgraph.get_master_uri()}: start one in another terminal with {start}"


def node_up(name, start):
    """Whether the node lives; start: the command that starts it."""
    nodes = look().nodes
    elsewhere = [node for node in nodes if node.endswith(name) and node != name]
    if name not in nodes and elsewhere:
        return f"{elsewhere[0]} runs in a namespace: start it without one"
    if name not in nodes:
        return f"There is no node {name}: start it in another terminal with {start}"
    if pid(name) is None:
        return f"The node {name} does not answer: end it (after Ctrl-Z: fg, then Ctrl-C), then start it with {start}"
    return None


def listens(node, topic):
    """Whether the node subscribes to the topic."""
    if node in look().subscribers.get(topic, ()):
        return None
    return f"{node} does not listen to {topic}: was it started in a namespace, or {topic} remapped?"


def has_type(topic, wanted):
    """Whether all who publish on the topic publish messages of this type."""
    for node in look().publishers.get(topic, ()):
        given = dict(ask(node, "getPublications") or ()).get(topic, wanted)
        if given != wanted:
            return (f"{node} publishes {given} on {topic}, not {wanted}: end it with Ctrl-C in its terminal; "
                    "a script of yours must name that type in rospy.Publisher")
    return None


def nobody_else_publishes(topic, package=None):
    """Whether nobody publishes on the topic, but for nodes of the package, and those that hang or are gone."""
    own = own_publishers(package, topic) if package else []
    nodes = [node for node in look().publishers.get(topic, ()) if node not in own and pid(node) is not None]
    return nodes and f"{nodes[0]} publishes on {topic}: end it with Ctrl-C in its terminal, then try again"


def publishes(package, topic, start):
    """Whether a node of the package publishes on the topic; start: the command that starts it."""
    if own_publishers(package, topic):
        return None
    graph = look()
    mine = sorted(node for node in graph.nodes if belongs(command_of(node), package))
    if not mine:
        hanging = "".join(f"; {node} was killed or hangs (fg, then Ctrl-C, ends it)" for node in sorted(graph.nodes)
                          if pid(node) is None)
        return (f"No node of {package} runs{hanging}: start it in another terminal with {start}; "
                "where it ends by itself, that terminal tells why")
    others = sorted(name for name, nodes in graph.publishers.items() if mine[0] in nodes and name != "/rosout")
    return f"{mine[0]} publishes on {' and '.join(others) or 'no topic'}, not on {topic}: name that in rospy.Publisher"


def own_publishers(package, topic):
    """The package's nodes that publish on the topic."""
    return [node for node in look().publishers.get(topic, ()) if belongs(command_of(node), package)]


def launched_together(*packages):
    """Whether one roslaunch runs nodes of all these packages."""
    if any(set(packages) <= running for running in launched()):
        return None
    return (f"No launch file runs {' and '.join(packages)}: end what runs, and start it with roslaunch; "
            "where you did so, read what it shows, and look at pkg and type of each <node>")


def launched():
    """For each roslaunch of this master: the packages of which it runs nodes."""
    uris = {}
    with contextlib.suppress(rosgraph.MasterException):  # none was ever started
        uris = rosgraph.Master(CALLER).getParam("/roslaunch/uris")
    return [set(packages_of(uri)) for uri in uris.values()]


def packages_of(uri):
    """The packages of which the roslaunch at this address runs nodes; none when it has ended."""
    with contextlib.suppress(*NO_ANSWER):
        launch = ServerProxy(uri, ImpatientTransport())
        for name, _ in launch.list_processes()[2][0]:
            with contextlib.suppress(Fault):  # of the master itself, which is in no package
                yield launch.process_info(name)[2]["package"]


def pid(node):
    """The node's process id, by its own word; None for one that does not answer."""
    return ask(node, "getPid")


def ask(node, question):
    """A node's answer to a question of ROS's slave API; None for one that does not answer."""
    with contextlib.suppress(*NO_ANSWER, rosgraph.MasterException):
        return getattr(ServerProxy(rosgraph.Master(CALLER).lookupNode(node), ImpatientTransport()), question)(CALLER)[2]
    return None


def command_of(node):
    """The interpreter and the script of a node on this computer, as paths."""
    with contextlib.suppress(OSError):
        process = Path("/proc", str(pid(node)))
        here = (process / "cwd").resolve()
        words = [word for word in (process / "cmdline").read_text().split("\0") if word and not word.startswith("-")]
        return [(here / word).resolve() for word in words[:2]]
    return []


def belongs(command, package):
    """Whether a command line starts a script of the package: its source, or what catkin makes of it."""
    home = folder(package).resolve()
    return any(path.parent.name == package or home in path.parents for path in command)
