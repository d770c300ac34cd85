"""class_judge.py judges a robot as often as a page asks for it, and offers its tasks to the cockpit."""

import os
import struct
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from driving_tasks.scoring.tasks import TASKS
from harness import START_TIMEOUT, SharedRobotTest, program, read

SIMULATOR = program("simulation", "simulator.py")
CLOCK = Path(__file__).resolve().parents[2] / "chaos/clock"  # Python imports it, and is off by CHAOS_CLOCK's seconds
SPEED = 0.5  # of full power


class ClassJudge(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.clock = Path(cls.shared.folder, "clock")
        cls.clock.write_bytes(struct.pack("d", 0))
        cls.shared.start(SIMULATOR, f"_i2c_bus:=fake:{cls.shared.bus}", env={
            **os.environ, "PYTHONPATH": f"{CLOCK}:{os.environ['PYTHONPATH']}", "CHAOS_CLOCK": str(cls.clock)})
        cls.shared.controller()
        cls.judge = cls.shared.start(program("driving_tasks", "class_judge.py"))

    def setUp(self):
        super().setUp()
        self.judged_before = len(read(self.judge).splitlines())
        self.offered, self.states, self.requests = [], [], rospy.Publisher("/judge_requests", KeyValue, queue_size=1)
        for topic, act in (("/judge_tasks", self.offered.append), ("/task", self.note)):
            self.addCleanup(rospy.Subscriber(topic, DiagnosticStatus, act).unregister)
        self.wait_for(lambda: self.offered and self.requests.get_num_connections(), START_TIMEOUT, "the judge")

    def note(self, message):
        self.states.append((message.name, {each.key: each.value for each in message.values}["state"],
                            message.message))

    def rows(self):
        """Return what the judge has printed in this test."""
        return read(self.judge).splitlines()[self.judged_before:]

    def ask(self, task):
        """Ask for the robot to be judged, and wait until it may drive."""
        self.states.clear()
        self.requests.publish("/", task)
        self.wait_for(lambda: [state[:2] for state in self.states][-1:] == [(task, "ready")], START_TIMEOUT, "ready")

    def drive(self, task):
        """Ask for the robot to be judged, and begin to drive."""
        self.ask(task)
        self.wait_for(lambda: self.command(SPEED) or self.states[-1][1] == "driving", START_TIMEOUT, "a drive")

    def test_a_robot_is_judged_as_often_as_it_is_asked_for(self):
        offered = {each.key: each.value for each in self.offered[0].values}
        self.assertEqual(offered, {name: task.title for name, task in TASKS.items() if name not in ("camera", "roam")})
        self.drive("metre")
        self.command(0.0)
        self.wait_for(lambda: self.states[-1][1] == "done", START_TIMEOUT, "the score")
        self.assertIn("Largest loss: ", self.states[-1][2])
        self.wait_for(lambda: len(self.rows()) == 1, START_TIMEOUT, "a mark")
        self.ask("quarter")

    def test_a_judge_in_a_terminal_waits_for_the_drive_and_advises_nobody_to_end_the_class(self):
        self.ask("metre")
        second = self.start(program("driving_tasks", "judge.py"), "metre")
        self.assertEqual(second.wait(START_TIMEOUT), 1)
        self.assertEqual(read(second), "/class_judge judges this robot already. Somebody has pressed Judge me. "
                                       "Wait until that drive has ended.\n")
        self.ask("quarter")  # the next test asks for another: this one is latched

    def test_an_interruption_ends_it_and_a_new_request_begins_again(self):
        self.ask("metre")
        self.emergency_stop(True)
        self.wait_for(lambda: self.states[-1][1] == "cancelled", START_TIMEOUT, "its end")
        self.assertIn("The robot is stopped: emergency stop.", self.states[-1][2])
        self.emergency_stop(False)
        self.ask("quarter")
        self.ask("metre")

    def test_a_clock_that_is_set_back_costs_no_drive_and_holds_up_none(self):
        self.drive("metre")
        with self.clock.open("r+b") as clock:
            clock.write(struct.pack("d", -3600))
        self.command(0.0)
        self.wait_for(lambda: self.states[-1][1] == "done", START_TIMEOUT, "the score")
        self.ask("quarter")  # the next test asks for another: this one is latched

    def test_a_program_that_is_stopped_gets_no_score(self):
        self.drive("metre")
        self.requests.publish("/", "")
        self.wait_for(lambda: self.states[-1][1] == "cancelled", START_TIMEOUT, "its end")
        self.assertEqual(self.states[-1][2], "The drive does not count: its program was stopped.")
        self.ask("quarter")
        self.assertEqual(self.rows(), [])
