"""Two programs that command one robot are both named, as long as both do; a turn that is cut off is reported."""

from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from harness import START_TIMEOUT, RobotTest


class TwoCommanders(RobotTest):
    def test_both_are_named(self):
        self.controller()
        self.commands().unregister()
        texts, arrays = self.status(), self.record("/diagnostics", DiagnosticArray)
        first, second = self.publisher(), self.publisher()
        self.wait_for(lambda: texts and texts[-1].startswith("driving, 2 programs command it: /rostopic_"),
                      START_TIMEOUT, f"both names in {texts}")
        self.wait_for(lambda: arrays and arrays[-1].status[0].level == DiagnosticStatus.WARN, 3.0, "a warning")
        second.kill()
        self.wait_for_status(texts, "driving", within=1.0)
        self.assertIsNone(first.poll())

    def test_both_wheels_at_full_power(self):
        self.controller()
        texts = self.status()
        self.command(1.5, 0.1)
        self.wait_for_status(texts, "driving, both wheels at full power")
        self.wait_for_wheels(1.0, 1.0)
        self.command(1.0, 0.0)
        self.wait_for_status(texts, "driving")
