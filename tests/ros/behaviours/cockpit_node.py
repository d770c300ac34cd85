"""The cockpit's node: a page drives, the robot stops with the page and with the node, and bad starts are refused."""

import math
import re
import signal
import time
from pathlib import Path

import rospkg
import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from geometry_msgs.msg import Point
from std_msgs.msg import String
from visualization_msgs.msg import Marker, MarkerArray

from harness import COCKPIT, START_TIMEOUT, RobotTest, publishers, read
from jetbot.wait import wait_until
from web_client import open_page

FULL, RELEASED = ({"type": "drive", "robot": "/", "forward": forward, "left": 0} for forward in (1, 0))
SEND_INTERVAL = 0.2  # s; more often, a cockpit that reads late would find too many messages at once


def polyline(namespace, across):
    """Return a marker from x to x, in m."""
    marker = Marker(ns=namespace, type=Marker.LINE_STRIP, points=[Point(x=x) for x in across])
    marker.scale.x = 0.01
    return marker


class CockpitNode(RobotTest):
    def drive(self, page):
        """Put a finger on the pad, and hold it at full deflection until the wheels turn."""
        page.receive_until(lambda message: message.get("robots", {}) and "/" in message["robots"])

        def is_driving():
            page.send(RELEASED)  # each time: the switch fires when this test itself comes too late
            page.send(FULL)
            return wait_until(lambda: self.wheels() == (1.0, 1.0), SEND_INTERVAL)
        self.wait_for(is_driving, 10.0, "the wheels to turn")

    def refused(self, *arguments):
        """Return what a cockpit prints that cannot start."""
        process = self.start(COCKPIT, *arguments)
        self.assertEqual(process.wait(START_TIMEOUT), 1)
        return read(process)

    def test_a_page_drives_and_the_robot_stops_with_it_and_with_the_node(self):
        self.controller(cmd_vel_timeout=0)  # nothing but the cockpit stops it
        cockpit, port = self.cockpit()

        page = open_page(port)
        self.drive(page)
        self.wait_for_stop(1.0)  # the browser is frozen: its socket is open, and silent
        self.drive(page)
        page.close()             # the browser is killed
        self.wait_for_stop(1.0)

        page = open_page(port)
        self.drive(page)
        cockpit.send_signal(signal.SIGSTOP)  # the controller notices it
        self.wait_for_stop(2.0)
        cockpit.send_signal(signal.SIGCONT)
        self.wheels_stay(0, 0, for_seconds=0.3)
        self.drive(page)
        start = time.monotonic()
        cockpit.send_signal(signal.SIGTERM)
        self.wait_for_stop(1.0)
        self.assertEqual(page.wait_for_close().code, 1001)
        self.assertEqual(cockpit.wait(5.0), 0)
        self.assertLess(time.monotonic() - start, 2.0)
        self.assertNotIn("Traceback", read(cockpit))

    def test_a_robot_that_is_stopped_on_a_page_is_stopped_when_it_comes_back(self):
        def is_stopped(message):
            return message["type"] == "state" and "emergency stop" in message["robots"].get("/", {}).get("status", "")

        node = self.controller()
        page = open_page(self.cockpit()[1])
        page.receive_until(lambda message: "/" in message.get("robots", {}))
        page.send({"type": "stop", "robot": "/"})
        page.receive_until(is_stopped)
        node.send_signal(signal.SIGINT)
        self.wait_for(lambda: not publishers("/jetbot_controller/status"), START_TIMEOUT, "the robot to end")
        self.wheels_stay(0, 0, for_seconds=2.0)  # meanwhile the cockpit asks the master
        self.controller()
        page.receive_until(is_stopped)

    def test_a_task_is_sent_to_a_page_whatever_else_is_published_on_its_topics(self):
        self.controller()
        _, port = self.cockpit()
        page = open_page(port)
        self.publish("world", MarkerArray([polyline("walls", (0.0, math.nan)), polyline("walls", (1.0, 2.0))]))
        self.publish("task_course", String("not a drawing"))
        self.publish("task", DiagnosticStatus(name="metre"))
        scene = page.receive_until(lambda message: message["type"] == "scene" and message["shapes"])
        self.assertEqual(scene, {"type": "scene", "robot": "/", "shapes": [
            {"kind": "wall", "width": 0.01, "points": [[1.0, 0.0], [2.0, 0.0]]}]})
        self.publish("task", DiagnosticStatus(name="metre", values=[KeyValue("state", "ready")]))
        state = page.receive_until(lambda message: message["type"] == "state" and message["robots"]["/"]["task"])
        self.assertEqual(state["robots"]["/"]["task"]["state"], "ready")

    def test_a_page_gets_how_the_robot_is(self):
        self.controller()
        page = open_page(self.cockpit()[1])
        state = page.receive_until(lambda message: message["type"] == "state"
                                   and message["robots"].get("/", {}).get("health"))
        self.assertEqual(state["robots"]["/"]["health"], [
            {"code": "battery", "template": "Battery: {volts} V, about {percent} %.",
             "arguments": {"volts": "12.1", "percent": "86"}, "level": "ok"}])

    def publish(self, topic, message):
        """Publish a message, latched, until the test ends."""
        publisher = rospy.Publisher(topic, type(message), queue_size=1, latch=True)
        self.addCleanup(publisher.unregister)
        publisher.publish(message)

    def test_codes_are_printed_and_not_logged(self):
        cockpit, port = self.cockpit("_lan:=true", "_name:=class.test")
        codes = re.findall(rf"http://class\.test:{port}/#(\w+)", read(cockpit))
        self.assertEqual(list(map(len, codes)), [6, 10])
        self.assertEqual(open_page(port, "class.test").wait_for_close().code, 4001)
        logs = [path.read_text(errors="replace") for path in Path(rospkg.get_log_dir()).rglob("*.log")]
        self.assertTrue(any("jetbot_cockpit" in log for log in logs))
        self.assertFalse([code for code in codes for log in logs if code in log])

    def test_a_second_one_and_a_taken_port_are_refused_in_one_sentence(self):
        cockpit, port = self.cockpit()
        self.assertIn("The node /jetbot_cockpit is already running", self.refused("_port:=0"))
        self.assertEqual(self.refused("__name:=other", f"_port:={port}"),
                         f"The cockpit cannot use port {port}: cockpit.py (process {cockpit.pid}) uses it. "
                         f"Choose another port: _port:={port + 1}\n")
        self.assertIsNone(cockpit.poll())
