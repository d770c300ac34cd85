"""class_judge.py judges a robot as often as it is asked to, from a page, too, and beside whatever else runs."""

import json
import os
import re
import signal
import struct
from pathlib import Path

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue

from driving_tasks.scoring.tasks import TASKS
from harness import START_TIMEOUT, SharedRobotTest, program, publishers, read
from jetbot.fake.motors import STOPPED
from web_client import open_page

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
        cls.cockpit_process, cls.port = cls.shared.cockpit()

    def setUp(self):
        super().setUp()
        self.rows_before = len(read(self.judge))
        self.offered, self.states, self.requests = [], [], rospy.Publisher("/judge_requests", KeyValue, queue_size=1)
        for topic, act in (("/judge_tasks", self.offered.append), ("/task", self.note)):
            self.addCleanup(rospy.Subscriber(topic, DiagnosticStatus, act).unregister)
        self.wait_for(lambda: self.offered and self.requests.get_num_connections(), START_TIMEOUT, "the judge")

    def note(self, message):
        self.values = {each.key: each.value for each in message.values}
        self.states.append((message.name, self.values["state"], message.message))

    def rows(self):
        """Return what the judge has printed in this test, but for rospy's warnings about links that were ending."""
        return [line for line in read(self.judge)[self.rows_before:].splitlines() if not line.startswith("[WARN]")]

    def ask(self, task):
        """Ask for the robot to be judged, and wait until it may drive."""
        self.states.clear()
        self.requests.publish("/", task)
        self.wait_for(lambda: [state[:2] for state in self.states][-1:] == [(task, "ready")], START_TIMEOUT, "ready")

    def stop_program(self):
        """Report that the program was stopped, and wait until the judge has given up."""
        self.requests.publish("/", "")
        self.wait_for(lambda: self.states[-1][1] == "cancelled", START_TIMEOUT, "its end")

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
        self.drive("metre")
        self.stop_program()
        self.assertEqual(self.states[-1][2], "The drive does not count: its program was stopped.")
        self.ask("quarter")
        self.stop_program()
        self.assertEqual(len(self.rows()), 1)

    def test_a_judge_in_a_terminal_waits_for_the_drive_and_advises_nobody_to_end_the_class(self):
        self.ask("metre")
        second = self.start(program("driving_tasks", "judge.py"), "metre")
        self.assertEqual(second.wait(START_TIMEOUT), 1)
        self.assertEqual(read(second), "/class_judge judges this robot already. Somebody has pressed Judge me. "
                                       "Wait until that drive has ended.\n")
        self.stop_program()

    def set_clock(self, seconds):
        """Let the simulator's clock be off by so much."""
        with self.clock.open("r+b") as clock:
            clock.write(struct.pack("d", seconds))

    def test_a_clock_that_is_set_back_costs_no_drive_and_holds_up_none(self):
        self.drive("metre")
        self.addCleanup(self.set_clock, 0)
        self.set_clock(-3600)
        self.command(0.0)
        self.wait_for(lambda: self.states[-1][1] == "done", START_TIMEOUT, "the score")
        self.ask("quarter")
        self.stop_program()

    def open_page(self):
        self.page = open_page(self.port)
        self.addCleanup(self.page.close)
        self.page.receive_until(lambda message: message["type"] == "tasks" and message["tasks"])
        self.page.receive_until(lambda message: "/" in message.get("robots", ()))

    def press(self, task="metre"):
        """Press Judge me; return the cockpit's answer."""
        self.page.send({"type": "judge", "robot": "/", "task": task})
        return self.page.receive("judge")

    def wait_for_report(self, request, *states, speed=None):
        """Return the robot's task once its judge says so; meanwhile keep the robot, or drive it at this speed."""
        message = {"type": "program"} if speed is None else {"type": "drive", "forward": speed, "left": 0.0}

        def is_reported(received):
            if received["type"] != "state":
                return False
            self.page.send({"robot": "/", **message})
            task = received["robots"]["/"]["task"]
            return task and task["request"] == request and task["state"] in states
        return self.page.receive_until(is_reported)["robots"]["/"]["task"]

    def begin_on_the_page(self):
        """Press Judge me, and drive."""
        self.open_page()
        request = self.press()["request"]
        self.wait_for_report(request, "ready")
        self.wait_for_report(request, "driving", speed=SPEED)

    def wait_for_end(self, code, sentence):
        """Wait until the judge has said why there is no score; fail if it has marked the drive."""
        self.wait_for(lambda: self.states[-1][1:] == ("cancelled", sentence), START_TIMEOUT, sentence)
        self.assertEqual((self.values["state"], json.loads(self.values["sentences"])), (
            "cancelled", [{"code": code, "template": sentence, "arguments": {}}]))
        self.wait_for_stop(1.0)
        self.assertEqual(self.rows(), [])

    def test_a_program_that_drives_waits_until_the_judge_has_a_score(self):
        self.open_page()
        self.publisher()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)
        request = self.press()["request"]
        (invitation,) = self.wait_for_report(request, "ready")["sentences"]
        self.assertEqual((invitation["template"], self.wheels()), (TASKS["metre"].invitation.template, STOPPED))
        self.wait_for_report(request, "driving", speed=SPEED)
        task = self.wait_for_report(request, "done", speed=0.0)
        (loss,) = task["sentences"]
        self.assertEqual(loss["template"].format(**loss["arguments"]), re.fullmatch(
            rf"Largest loss: (.*) \({task['lost']} points\)\.", task["text"])[1])
        self.wait_for(lambda: len(self.rows()) == 1, START_TIMEOUT, "a mark")
        self.page.close()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)

    def test_beside_judge_py_it_is_refused_and_that_judge_goes_on(self):
        self.open_page()
        self.wait_for(lambda: not publishers("/task"), START_TIMEOUT, "the judge of the test before to let go")
        judge = self.start(program("driving_tasks", "judge.py"), "metre", cwd=self.folder)
        self.wait_for_report("", "ready")
        for task in "metre", "square":
            self.assertEqual(self.press(task)["refusal"]["code"], "judged_elsewhere")
        self.wait_for_report("", "ready")
        self.assertIsNone(judge.poll())

    def test_when_the_cockpit_is_killed_while_it_drives_there_is_no_score(self):  # the last one
        self.begin_on_the_page()
        self.cockpit_process.send_signal(signal.SIGKILL)
        self.wait_for_end("not_counted_cockpit_ended", "The drive does not count: the cockpit has ended.")

    def test_a_page_that_is_closed_leaves_no_score(self):
        self.begin_on_the_page()
        self.page.close()
        self.wait_for_end("not_counted_left",
                          "The drive does not count: the driver's page was closed, or lost its connection.")
