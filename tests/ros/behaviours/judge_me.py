"""Judge me, from a page's socket to the judge's score, beside whatever else runs."""

import json
import re
import signal

from diagnostic_msgs.msg import DiagnosticStatus

from driving_tasks.scoring.tasks import TASKS
from harness import START_TIMEOUT, SharedRobotTest, program, read
from jetbot.fake.motors import STOPPED
from web_client import open_page

SPEED = 0.5  # of full power


class JudgeMe(SharedRobotTest):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.shared.start(program("simulation", "simulator.py"), f"_i2c_bus:=fake:{cls.shared.bus}")
        cls.shared.controller()
        cls.judge = cls.shared.start(program("driving_tasks", "class_judge.py"))

    def setUp(self):
        super().setUp()
        self.rows_before = read(self.judge)
        self.cockpit_process, port = self.cockpit()
        self.page = open_page(port)
        self.page.receive_until(lambda message: message["type"] == "tasks" and message["tasks"])
        self.page.receive_until(lambda message: "/" in message.get("robots", ()))
        self.reports = self.record("/task", DiagnosticStatus, lambda status: status)

    def rows(self):
        """Return what the judge has printed in this test, but for rospy's warnings about links that were ending."""
        lines = read(self.judge)[len(self.rows_before):].splitlines(keepends=True)
        return "".join(line for line in lines if not line.startswith("[WARN]"))

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

    def begin(self):
        """Press Judge me, and drive; return the word of the request."""
        request = self.press()["request"]
        self.wait_for_report(request, "ready")
        self.wait_for_report(request, "driving", speed=SPEED)
        return request

    def wait_for_end(self, code, sentence):
        """Wait until the judge has said why there is no score; fail if it has marked the drive."""
        self.wait_for(lambda: self.reports[-1:] and self.reports[-1].message == sentence, START_TIMEOUT, sentence)
        values = {pair.key: pair.value for pair in self.reports[-1].values}
        self.assertEqual((values["state"], json.loads(values["sentences"])), (
            "cancelled", [{"code": code, "template": sentence, "arguments": {}}]))
        self.wait_for_stop(1.0)
        self.assertEqual(self.rows(), "")

    def test_a_program_that_drives_waits_until_the_judge_has_a_score(self):
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
        self.wait_for(lambda: self.rows().count("\n") == 1, START_TIMEOUT, "a mark")
        self.page.close()
        self.wait_for_wheels(0.5, 0.5, START_TIMEOUT)

    def test_beside_judge_py_it_is_refused_and_that_judge_goes_on(self):
        judge = self.start(program("driving_tasks", "judge.py"), "metre", cwd=self.folder)
        self.wait_for_report("", "ready")
        for task in "metre", "square":
            self.assertEqual(self.press(task)["refusal"]["code"], "judged_elsewhere")
        self.wait_for_report("", "ready")
        self.assertIsNone(judge.poll())

    def test_a_cockpit_that_is_killed_while_it_drives_leaves_no_score(self):
        self.begin()
        self.cockpit_process.send_signal(signal.SIGKILL)
        self.wait_for_end("not_counted_cockpit_ended", "The drive does not count: the cockpit has ended.")

    def test_a_page_that_is_closed_leaves_no_score(self):
        self.begin()
        self.page.close()
        self.wait_for_end("not_counted_left",
                          "The drive does not count: the driver's page was closed, or lost its connection.")
