"""What the cockpit drives, stops and shows of a real controller, whose process may freeze or be killed."""

import math
import signal
import threading
import time
from functools import partial

import rospy
from geometry_msgs.msg import TransformStamped
from nav_msgs.msg import Odometry
from std_srvs.srv import Empty, EmptyResponse
from tf2_msgs.msg import TFMessage

from harness import CONTROLLER, START_TIMEOUT, SharedRobotTest, near, publishers
from jetbot_cockpit.classroom.classroom import Classroom
from jetbot_cockpit.robots.command_publishers import Drivers
from jetbot_cockpit.robots.discovery import Robots
from jetbot_cockpit.session.collection import Collection
from jetbot_cockpit.session.control import Control
from jetbot_cockpit.session.messages import problem_of
from jetbot_cockpit.session.protocol import Message
from jetbot_cockpit.session.rights import Client

ADA, TEACHER = Client(1, "pupil"), Client(2, "teacher")
LET_GO, NO_ANSWER = "Let go, then drive again.", "robot does not answer."
RELEASE_FIRST = "Emergency stop: it must be released first."
RELEASE_OWN_FIRST = "its own emergency stop must be released first."


def wait_for_page(condition):
    """Return the condition, which is then evaluated 20 times a second, as a page sends its commands."""
    def evaluate():
        time.sleep(0.05)
        return condition()
    return evaluate


class CockpitDrive(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        """Start one controller, and one cockpit, for all tests."""
        super().setUpClass()
        cls.drivers, cls.robots = Drivers(), Robots()
        cls.start_controller()

    @classmethod
    def start_controller(cls):
        cls.process = cls.shared.start(CONTROLLER, f"_i2c_bus:=fake:{cls.shared.bus}", "_cmd_vel_timeout:=0")

    def setUp(self):
        super().setUp()
        self.control = Control(self.robots, self.drivers, None, Collection(False), Classroom())
        self.lock = threading.Lock()
        self.addCleanup(self.drivers.close)
        checks = rospy.Timer(rospy.Duration(0.05), self.check)
        self.addCleanup(checks.shutdown)
        self.wait_for(lambda: self.robot().get("answers") and self.robot()["status"].startswith("stopped: "),
                      START_TIMEOUT, "the cockpit to know the robot")

    def check(self, _):
        with self.lock:
            self.control.check(time.monotonic())

    def do(self, client, message):
        with self.lock:
            if message.type == "stop":
                return self.control.stop(client, message.robot)
            return self.control.handle(client, message, time.monotonic())

    def lift(self):
        self.do(ADA, Message("drive", "/", 0.0, 0.0))

    def robot(self):
        """Return the robot's state, {} if there is none."""
        state = self.control.state()
        self.assertIsNone(problem_of(state))
        return state["robots"].get("/", {})

    def hold(self, forward=0.5):
        """Hold the pad down for one message of the page; return why that is refused, or ""."""
        reply = self.do(ADA, Message("drive", "/", forward, 0.0))
        return reply["text"] if reply else ""

    def push(self, forward):
        """Hold the pad down until the wheels turn at this speed; this computer may be slower than the switch."""
        def reached():
            if self.hold(forward):
                self.lift()
            return near(self.wheels(), (forward, forward))

        self.wait_for(wait_for_page(reached), START_TIMEOUT, f"the pad to drive at {forward}")

    def wait_for_refusal(self, text):
        """Hold the pad down until that is refused, for this reason."""
        self.wait_for(wait_for_page(lambda: self.hold().endswith(text)), START_TIMEOUT, f"the refusal {text!r}")

    def test_a_pad_drives_until_it_is_released_and_then_nobody_publishes(self):
        self.push(0.5)
        self.wait_for(wait_for_page(lambda: self.hold() or self.robot()["wheels"] == (0.5, 0.5)), 5.0, "its wheels")
        self.assertEqual(self.robot()["command"], (0.5, 0.0))
        self.lift()
        self.wait_for_stop(within=1.0)
        self.wait_for(lambda: not publishers("/cmd_vel"), 5.0, "the publisher to end")

    def test_the_emergency_stop_of_all_that_of_one_and_one_by_another_program(self):
        for stop, release, status, refusal in (
                (partial(self.do, ADA, Message("stop")), partial(self.do, ADA, Message("release")),
                 "emergency stop", RELEASE_FIRST),
                (partial(self.do, TEACHER, Message("stop", "/")), partial(self.do, TEACHER, Message("release", "/")),
                 "its own emergency stop", RELEASE_OWN_FIRST),
                (partial(self.emergency_stop, True), partial(self.emergency_stop, False),
                 "emergency stop", RELEASE_FIRST)):
            self.push(0.5)
            stop()
            self.wait_for_stop(within=1.0)
            self.wait_for(lambda status=status: self.robot()["status"].startswith(f"stopped: {status}"), 5.0, status)
            self.wait_for_refusal(refusal)
            release()
            self.wait_for_refusal(LET_GO)
            self.lift()

    def test_a_robot_that_freezes_or_is_killed_does_not_answer_and_does_not_jump_off_later(self):
        self.push(0.5)
        self.process.send_signal(signal.SIGSTOP)
        self.wait_for_refusal(NO_ANSWER)
        self.assertIs(self.robot()["answers"], False)
        self.process.send_signal(signal.SIGCONT)
        self.wait_for_refusal(LET_GO)
        self.wait_for_stop(within=1.0)
        self.lift()
        self.push(0.5)
        self.process.kill()
        self.wait_for(lambda: not self.robot()["answers"], 5.0, "the loss of the robot")
        self.wait_for_refusal(NO_ANSWER)
        self.start_controller()
        self.wait_for_refusal(LET_GO)
        self.wheels_stay(0, 0, for_seconds=0.3)

    def test_a_robot_is_shown_where_its_odometry_is_on_the_map(self):
        origins = rospy.Publisher("/tf_static", TFMessage, queue_size=1, latch=True)
        poses = rospy.Publisher("/odom", Odometry, queue_size=1, latch=True)
        self.addCleanup(origins.unregister)
        self.addCleanup(poses.unregister)
        origin = TransformStamped(child_frame_id="odom")
        origin.header.frame_id, origin.transform.translation.x = "map", 1.0
        origin.transform.rotation.z = origin.transform.rotation.w = math.sqrt(0.5)
        origins.publish([origin])
        odom = Odometry()
        odom.header.frame_id, odom.pose.pose.position.x, odom.pose.pose.orientation.w = "odom", 0.5, 1.0
        odom.twist.twist.linear.x = 0.3

        def shown():
            poses.publish(odom)
            return self.robot()["pose"] == (1.0, 0.5, 1.571) and self.robot()["speed"] == (0.3, 0.0)

        self.wait_for(wait_for_page(shown), START_TIMEOUT, "its pose on the map, and its speed")
        self.wait_for(lambda: self.robot()["speed"] is None, START_TIMEOUT, "a speed that nobody repeats to vanish")

    def test_a_simulator_that_hangs_while_it_is_reset_holds_nobody_up(self):
        ended, calls = threading.Event(), []
        self.addCleanup(ended.set)
        service = rospy.Service("/jetbot_simulator/reset", Empty,
                                lambda _: calls.append(ended.wait(START_TIMEOUT)) or EmptyResponse())
        self.addCleanup(service.shutdown)
        self.wait_for(lambda: self.control.robots()[0]["simulated"], 5.0, "the simulator")
        start = time.monotonic()
        self.assertIsNone(self.do(TEACHER, Message("reset")))
        self.push(0.5)
        self.assertEqual(self.do(TEACHER, Message("reset"))["text"], "The simulator does not answer: robot.")
        self.assertEqual(calls, [])
        self.assertLess(time.monotonic() - start, START_TIMEOUT / 2)
