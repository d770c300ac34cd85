"""The cockpit's node: a page drives, the robot stops with the page and with the node, and bad starts are refused."""

import math
import re
import signal
from pathlib import Path

import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from harness import COCKPIT, START_TIMEOUT, SharedRobotTest, publishers, read
from jetbot.wait import wait_until
from web_client import open_page

FULL, RELEASED = ({"type": "drive", "robot": "/", "forward": forward, "left": 0} for forward in (1, 0))
SEND_INTERVAL = 0.2  # s; more often, a cockpit that reads late would find too many messages at once


def polyline(namespace, across):
    """Return a marker from x to x, in m."""
    marker = Marker(ns=namespace, type=Marker.LINE_STRIP, points=[Point(x=x) for x in across])
    marker.scale.x = 0.01
    return marker


class CockpitNode(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        """Start a controller that nothing but the cockpit stops, and a cockpit that other computers reach, too."""
        super().setUpClass()
        cls.node = cls.shared.controller(cmd_vel_timeout=0)
        cls.process, cls.port = cls.shared.cockpit("_lan:=true", "_name:=class.test")

    def setUp(self):
        super().setUp()
        self.page = open_page(self.port)
        self.addCleanup(self.page.close)
        self.page.receive_until(lambda message: "/" in message.get("robots", {}))

    def drive(self, page):
        """Put a finger on the pad, and hold it at full deflection until the wheels turn."""
        def is_driving():
            page.send(RELEASED)  # each time: the switch fires when this test itself comes too late
            page.send(FULL)
            return wait_until(lambda: self.wheels() == (1.0, 1.0), SEND_INTERVAL)
        self.wait_for(is_driving, 10.0, "the wheels to turn")

    def wait_until_shown(self, text):
        """Fail unless the page shows that the robot's status has this text."""
        self.page.receive_until(lambda message: message["type"] == "state"
                                and text in message["robots"].get("/", {}).get("status", ""))

    def refused(self, *arguments):
        """Return what a cockpit prints that cannot start."""
        process = self.start(COCKPIT, *arguments)
        self.assertEqual(process.wait(START_TIMEOUT), 1)
        return read(process)

    def test_a_page_drives_and_the_robot_stops_with_it_and_while_the_node_is_frozen(self):
        self.drive(self.page)
        self.wait_for_stop(1.0)  # the browser is frozen: its socket is open, and silent
        self.drive(self.page)
        self.page.close()        # the browser is killed
        self.wait_for_stop(1.0)

        page = open_page(self.port)
        self.drive(page)
        self.process.send_signal(signal.SIGSTOP)  # the controller notices it
        self.wait_for_stop(2.0)
        self.process.send_signal(signal.SIGCONT)
        self.wheels_stay(0, 0, for_seconds=0.3)
        self.drive(page)

    def test_the_end_of_the_node_stops_the_robot_and_tells_the_pages(self):  # the last one
        self.drive(self.page)
        self.process.send_signal(signal.SIGTERM)
        self.wait_for_stop(1.0)
        self.wait_for(lambda: self.process.poll() == 0, 2.0, "its end")
        self.assertEqual(self.page.wait_for_close().code, 1001)
        self.assertNotIn("Traceback", read(self.process))

    def test_a_robot_that_is_stopped_on_a_page_is_stopped_when_it_comes_back(self):
        self.page.send({"type": "stop", "robot": "/"})
        self.wait_until_shown("emergency stop")
        self.node.send_signal(signal.SIGINT)
        self.wait_for(lambda: not publishers("/jetbot_controller/status"), START_TIMEOUT, "the robot to end")
        self.wheels_stay(0, 0, for_seconds=2.0)  # meanwhile the cockpit asks the master
        type(self).node = self.shared.controller(cmd_vel_timeout=0)
        self.wait_until_shown("emergency stop")
        self.page.send({"type": "release", "robot": "/"})
        self.wait_until_shown("no command since its own emergency stop was released")

    def test_a_task_is_sent_to_a_page_whatever_else_is_published_on_its_topics(self):
        self.publish("world", MarkerArray([polyline("walls", (0.0, math.nan)), polyline("walls", (1.0, 2.0))]))
        self.publish("task_course", String("not a drawing"))
        self.publish("task", DiagnosticStatus(name="metre"))
        scene = self.page.receive_until(lambda message: message["type"] == "scene" and message["shapes"])
        self.assertEqual(scene, {"type": "scene", "robot": "/", "shapes": [
            {"kind": "wall", "width": 0.01, "points": [[1.0, 0.0], [2.0, 0.0]]}]})
        self.publish("task", DiagnosticStatus(name="metre", values=[KeyValue("state", "ready")]))
        state = self.page.receive_until(lambda message: message["type"] == "state" and message["robots"]["/"]["task"])
        self.assertEqual(state["robots"]["/"]["task"]["state"], "ready")

    def test_a_page_gets_how_the_robot_is(self):
        state = self.page.receive_until(
            lambda message: message["type"] == "state" and message["robots"].get("/", {}).get("health"))
        self.assertEqual(state["robots"]["/"]["health"], [
            {"code": "battery", "template": "Battery: {volts} V, about {percent} %.",
             "arguments": {"volts": "12.1", "percent": "86"}, "level": "ok"}])

    def publish(self, topic, message):
        """Publish a message, latched, until the test ends."""
        publisher = rospy.Publisher(topic, type(message), queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(message)

    def test_codes_are_printed_and_not_logged(self):
        codes = re.findall(rf"http://class\.test:{self.port}/#(\w+)", read(self.process))
        self.assertEqual(list(map(len, codes)), [6, 10])
        self.assertEqual(open_page(self.port, "class.test").wait_for_close().code, 4001)
        logs = [path.read_text(errors="replace") for path in Path(rospkg.get_log_dir()).rglob("*.log")]
        self.assertTrue(any("jetbot_cockpit" in log for log in logs))
        self.assertFalse([code for code in codes for log in logs if code in log])

    def test_a_second_one_and_a_taken_port_are_refused_in_one_sentence(self):
        self.assertIn("The node /jetbot_cockpit is already running", self.refused("_port:=0"))
        self.assertEqual(self.refused("__name:=other", f"_port:={self.port}"),
                         f"The cockpit cannot use port {self.port}: cockpit.py (process {self.process.pid}) uses it. "
                         f"Choose another port: _port:={self.port + 1}\n")
        self.assertIsNone(self.process.poll())
