"""Programs that have nothing to do with the robots, and that the master waits for when it announces publishers.

rosmaster does so from three threads without a time limit (ros_comm#1555).
"""

import contextlib
import signal
import socket
import sys
from pathlib import Path
from typing import Callable

from jetbot.wait import wait_until
from jetbot_ros.master import NO_ANSWER

PROGRAM = Path(__file__).with_name("listener.py")
START_TIMEOUT = 6.0  # s
OF_ALL = {"/emergency_stop": "std_msgs/Bool", "/diagnostics": "diagnostic_msgs/DiagnosticArray"}
OF_ONE = {"cmd_vel": "geometry_msgs/Twist", "jetbot_controller/status": "std_msgs/String", "odom": "nav_msgs/Odometry"}


def frozen(scene, process, chance):
    """Start some `rostopic echo`, and freeze them once they listen, as Ctrl-Z does."""
    topic, _ = draw_topic(scene, chance)
    count, before = chance.randint(3, 6), scene.topic(1, topic)
    echoes = scene.start("bystander", sys.executable, str(PROGRAM), str(count), topic)
    wait_until(lambda: len(scene.topic(1, topic) - before) >= count, START_TIMEOUT, 0.05)
    echoes.signal_all(signal.SIGSTOP)
    return echoes.end


def mute(method: str, reachable: bool) -> Callable:
    """Return a fault that registers some nodes that never answer; the master's ``method`` says as what.

    reachable: they accept connections; else nothing is answered, as by a computer that is off.
    """
    def begin(scene, process, chance):
        topic, kind = draw_topic(scene, chance)
        nodes = [socket.create_server(("localhost", 0), backlog=16 * reachable) for _ in range(chance.randint(3, 6))]
        waiting = [] if reachable else [connect(node) for node in nodes for _ in range(2)]  # they fill the backlog
        for port in [node.getsockname()[1] for node in nodes]:
            with contextlib.suppress(*NO_ANSWER):
                scene.ask_master(method, topic, kind, f"http://localhost:{port}", caller=f"/bystander_{port}")
        return lambda: [each.close() for each in nodes + waiting]
    return begin


def connect(node: socket.socket) -> socket.socket:
    """Return a connection to a node, which may not accept it."""
    connection = socket.socket()
    connection.setblocking(False)
    with contextlib.suppress(BlockingIOError):
        connection.connect(node.getsockname())
    return connection


def draw_topic(scene, chance):
    """Return a topic and its type."""
    own = {f"/{robot}/{topic}": kind for robot in scene.names for topic, kind in OF_ONE.items()}
    return chance.choice(sorted({**OF_ALL, **own}.items()))
