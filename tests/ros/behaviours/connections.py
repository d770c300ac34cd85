"""Where ROS_HOSTNAME is localhost, only publishers of this computer are heard; nothing, and no flood, delays a stop."""

import socket
import struct
import threading
import time
from pathlib import Path
from xmlrpc.client import ServerProxy
from xmlrpc.server import SimpleXMLRPCServer

import rosgraph
import rospy
from diagnostic_msgs.msg import DiagnosticArray
from std_msgs.msg import String

from harness import START_TIMEOUT, RobotTest, read
from jetbot.fake.bus import power_on

NUMBER = "2130706433"  # 127.0.0.1, written so that it counts as another computer's name
CALLER = "/jetbot_controller"
TWIST = ("/cmd_vel", "geometry_msgs/Twist")


class Publisher:
    """The addresses of a publisher: it offers its messages at ``offered``, and counts who asks and who connects."""

    def __init__(self, offered):
        self.asked, self.connected = [], []
        self._socket = socket.create_server(("127.0.0.1", 0))
        self._server = SimpleXMLRPCServer(("127.0.0.1", 0), logRequests=False)
        self._server.register_function(lambda *call: self.asked.append(call) or self._answer(offered), "requestTopic")
        self.port = self._server.server_address[1]
        for target in (self._server.serve_forever, self._accept):
            threading.Thread(target=target, daemon=True).start()

    def _answer(self, offered):
        return [1, "", ["TCPROS", offered, self._socket.getsockname()[1]]]

    def _accept(self):
        while True:
            self.connected.append(self._socket.accept())


class Connections(RobotTest):
    def setUp(self):
        super().setUp()
        power_on(self.bus)
        Path(self.bus, "clock").write_text("100000")
        self.node = self.controller(cmd_vel_timeout=0)
        self.address = rosgraph.Master("/test").lookupNode(CALLER)

    def announce(self, publisher, host):
        """Announce a publisher of commands at this host, as the master does."""
        ServerProxy(self.address).publisherUpdate("/master", TWIST[0], [f"http://{host}:{publisher.port}/"])

    def test_another_computer_is_neither_asked_nor_connected_to(self):
        elsewhere, offered_elsewhere = Publisher("127.0.0.1"), Publisher(NUMBER)
        self.announce(elsewhere, NUMBER)
        self.wait_for(lambda: "refused a publisher at 'http://2130706433:" in read(self.node), START_TIMEOUT, "a line")
        self.announce(offered_elsewhere, "localhost")
        self.wait_for(lambda: offered_elsewhere.asked, START_TIMEOUT, "a question")
        self.drive_at(0.25)
        self.assertEqual([elsewhere.asked, elsewhere.connected, offered_elsewhere.connected], [[], [], []])

    def test_a_publisher_of_another_type_is_named_and_keeps_no_other_out(self):
        self.start("rostopic", "pub", "-r", "10", "/cmd_vel", "std_msgs/String", "forward")
        self.wait_for(lambda: "topic types do not match" in read(self.node), START_TIMEOUT, "a line")
        self.drive_at(0.25)
        self.assertEqual(read(self.node).count("topic types do not match"), 1, read(self.node))

    def test_connections_without_a_header_block_nobody(self):
        _, _, (_, _, port) = ServerProxy(self.address).requestTopic("/test", "/jetbot_controller/status", [["TCPROS"]])
        silent = [socket.create_connection(("localhost", port)) for _ in range(20)]
        endless = socket.create_connection(("localhost", port))
        endless.sendall(struct.pack("<I", 2 ** 31))
        self.assertTrue(is_closed(endless, within=3.0), "at once")
        rospy.wait_for_message("/jetbot_controller/status", String, START_TIMEOUT)
        rospy.wait_for_message("/diagnostics", DiagnosticArray, START_TIMEOUT)
        self.assertTrue(is_closed(silent[0], within=START_TIMEOUT))

    def test_a_stop_after_2_s_of_1000_commands_a_second_waits_in_no_queue(self):
        start = time.monotonic()
        for i in range(2000):
            self.command(0.3 + 0.4 * (i % 2), 0.1)
            time.sleep(max(0, start + i / 1000 - time.monotonic()))
        self.assertNotEqual(self.wheels(), (0, 0))
        self.command(0)
        self.wait_for_stop(within=0.1)
        self.wheels_stay(0, 0, for_seconds=0.5)


def is_closed(connection, within):
    """Return whether the other end closes the connection within this many seconds."""
    connection.settimeout(within)
    try:
        return connection.recv(1) == b""
    except ConnectionResetError:
        return True
    except socket.timeout:
        return False
