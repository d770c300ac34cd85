"""judge.py judges the drive of a simulated robot, from its first motion to its stop, and moves no wheel itself."""

import json
import math
import os
import re
import signal
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticStatus
from geometry_msgs.msg import Pose2D
from nav_msgs.msg import Odometry
from visualization_msgs.msg import Marker, MarkerArray

from driving_tasks.scoring.recorder import MOVED
from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources.bags import judge_bag
from harness import START_TIMEOUT, SharedRobotTest, program, read
from jetbot.fake.motors import STOPPED

JUDGE = program("driving_tasks", "judge.py")
SIMULATOR = program("simulation", "simulator.py")
READY = "Drive when you are ready."
TAKEN = "The drive does not count: a teacher took the robot over."
BY_CAMERA = "End it: in this task, programs see with the camera alone."
BLIND = "The drive does not count. No program looks at the camera, with which this task is driven."
RELEASE = "The robot is stopped: emergency stop. Release it: ./morbot stop --release"
SPEED, DISTANCE = 0.5, 0.98  # of full power; m, after which it is to stop: about a metre with what it rolls on
SLOW = 0.1                   # of full power


class Judge(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.simulator = cls.shared.start(SIMULATOR, f"_i2c_bus:=fake:{cls.shared.bus}", "_x:=2", "_yaw:=1")
        cls.shared.controller()

    def judge(self, task):
        """Start the judge."""
        return self.start(JUDGE, task, cwd=self.folder)

    def report_driver(self, name, interruption=""):
        """Say who drives, and what has interrupted that, as the cockpit does."""
        self.start("rostopic", "pub", "/driver", DiagnosticStatus._type,
                   json.dumps({"message": interruption, "values": [{"key": "name", "value": name}]}))

    def wait_for_lines(self, judge, *lines):
        """Fail unless the judge has printed these lines."""
        self.wait_for(lambda: read(judge).splitlines() == [*lines], START_TIMEOUT, f"{lines}")

    def drive(self, distance):
        """Command SPEED until the robot has driven so far, in m."""
        places = self.record("jetbot_simulator/ground_truth", Odometry, lambda message: message.pose.pose.position)
        self.wait_for(lambda: places, START_TIMEOUT, "the robot's place")

        def driven():
            return math.hypot(places[-1].x - places[0].x, places[-1].y - places[0].y)
        self.wait_for(lambda: self.command(SPEED) or driven() > distance, START_TIMEOUT, "the end of the drive")
        self.command(0.0)

    def wait_for_last_lines(self, judge, line, before=""):
        """Fail unless this becomes the judge's last line, after another one."""
        self.wait_for(lambda: re.search(f"{re.escape(before)}\n(.*\n)*{re.escape(line)}\n$", read(judge)),
                      START_TIMEOUT, f"{before} {line}")

    def move_by_hand(self, *steps):
        """Move the robot by ``set_pose``, along these steps in m, to places that are as near as a robot drives."""
        set_pose = rospy.Publisher("jetbot_simulator/set_pose", Pose2D, queue_size=1)
        truth = self.record("jetbot_simulator/ground_truth", Odometry, lambda message: message.pose.pose.position)
        self.wait_for(lambda: truth and set_pose.get_num_connections(), START_TIMEOUT, "the simulator")
        for pose in [Pose2D(truth[-1].x + step * math.cos(1), truth[-1].y + step * math.sin(1), 1.0) for step in steps]:
            set_pose.publish(pose)
            self.wait_for(lambda at=pose: (truth[-1].x, truth[-1].y) == (at.x, at.y), START_TIMEOUT, "the robot there")

    def drive_until(self, judge, text):
        """Command a speed at which the robot is far from all walls until the judge has printed this."""
        self.wait_for(lambda: self.command(SLOW) or text in read(judge), START_TIMEOUT, text)

    def begin_to_drive(self, states):
        self.wait_for(lambda: self.command(SLOW) or states and states[-1].values[0].value == "driving", START_TIMEOUT,
                      "the drive")

    def test_a_drive_gets_a_score_and_its_record_the_same(self):
        states = self.record("task", DiagnosticStatus, lambda status: status)
        courses = self.record("task_course", MarkerArray, lambda array: array.markers)
        options = "metre", "--record", "drive.bag", "--csv", "marks.csv"
        judge = self.start(JUDGE, *options, cwd=self.folder)
        self.report_driver("=Ada")
        self.wait_for_lines(judge, READY)
        self.assertEqual(self.wheels(), STOPPED)
        self.wait_for(lambda: courses, START_TIMEOUT, "the course")
        self.assertEqual([each.type for each in courses[-1][1:]], [Marker.LINE_STRIP, Marker.ARROW])
        self.assertAlmostEqual(courses[-1][2].pose.position.x, 2.54, places=2)
        self.drive(DISTANCE)
        self.assertEqual(judge.wait(START_TIMEOUT), 0)
        report = (rf"\A{READY}\nmetre: (\d+\.\d) of 100 points in \d\.\d s\.\n"
                  r"(Largest loss: stopped .*)\nDrawing metre\.png \.\.\.\n"
                  r"(?:Matplotlib is building .*\n)?Drew metre\.png\.\nWrote marks\.csv\.\n\Z")
        self.assertRegex(read(judge), report)
        score, loss = re.search(report, read(judge)).groups()
        values = [{pair.key: pair.value for pair in each.values} for each in states]
        self.assertEqual(list(dict.fromkeys(each["state"] for each in values)), ["ready", "driving", "done"])
        self.assertEqual((values[-1]["score"], values[-1]["driver"], states[-1].message), (score, "=Ada", loss))
        table = Path(self.folder, "marks.csv").read_text("utf-8-sig")
        self.assertIn(f"robot,'=Ada,metre,{score},", table.replace("\n", ","))
        bag = judge_bag(TASKS["metre"], os.path.join(self.folder, "drive.bag"))
        self.assertEqual((f"{bag.result.score:.1f}", bag.source), (score, ""))

    def test_in_a_task_by_camera_who_reads_where_the_robot_is_must_end(self):
        reader = rospy.Subscriber("odom", Odometry, lambda _: None)
        judge = self.judge("camera")
        self.wait_for_lines(judge, f"{rospy.get_name()} reads /odom. {BY_CAMERA}")
        reader.unregister()
        self.wait_for_last_lines(judge, READY, before=BY_CAMERA)
        self.drive_until(judge, BLIND)
        self.wait_for_last_lines(judge, READY, before=BLIND)

    def test_what_interrupts_a_drive_ends_no_judge_and_a_signal_gives_the_world_back(self):
        worlds = self.record("world", MarkerArray, lambda array: len(array.markers))
        judge = self.judge("park")
        self.wait_for_lines(judge, READY)
        self.wait_for(lambda: worlds[-1:] == [2], START_TIMEOUT, "the world: one clears the drawing, one is a wall")
        self.move_by_hand(0.01, 0.02, 0.03)
        self.wait_for_last_lines(judge, READY, before=MOVED)
        states = self.record("task", DiagnosticStatus, lambda status: status)
        self.begin_to_drive(states)
        self.report_driver("Ada", "a teacher took the robot over")
        self.drive_until(judge, TAKEN)
        self.wait_for_last_lines(judge, READY, before=TAKEN)
        self.wait_for(lambda: states[-1].message.startswith(f"{TAKEN} {READY[:-1]}: "), START_TIMEOUT, "it on the page")
        second = self.judge("metre")
        self.assertEqual(second.wait(START_TIMEOUT), 1)
        self.assertRegex(read(second), r"^/judge judges this robot already\. End it first: .*\n$")
        self.begin_to_drive(states)
        self.emergency_stop(True)
        self.drive_until(judge, RELEASE)
        self.wait_for_last_lines(judge, f"The drive does not count. {RELEASE}")
        self.emergency_stop(False)
        self.wait_for_last_lines(judge, READY, before=RELEASE)
        os.killpg(self.simulator.pid, signal.SIGSTOP)
        self.wait_for(lambda: "The simulator does not answer." in read(judge), START_TIMEOUT, "a sentence")
        os.killpg(self.simulator.pid, signal.SIGCONT)
        self.wait_for_last_lines(judge, READY)
        os.kill(judge.pid, signal.SIGTERM)
        self.assertEqual(judge.wait(START_TIMEOUT), 130)
        self.assertEqual(read(judge).splitlines()[-1], "Cancelled.")
        self.wait_for(lambda: worlds[-1] == 1, START_TIMEOUT, "the world without walls")
