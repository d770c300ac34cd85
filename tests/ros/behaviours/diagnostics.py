"""/diagnostics reports what the robot does and why it is stopped."""

import os

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from harness import RobotTest
from jetbot.fake.bus import power_on


class Diagnostics(RobotTest):
    def setUp(self):
        super().setUp()
        self.arrays = self.record("/diagnostics", DiagnosticArray)

    def latest(self):
        return self.arrays[-1].status[0]

    def values(self):
        return {pair.key: pair.value for pair in self.latest().values}

    def wait_for_level(self, *wanted):
        self.wait_for(lambda: self.arrays and (self.latest().level, self.latest().message) == wanted, 5.0,
                      f"{wanted} in /diagnostics")

    def test_levels_and_values(self):
        self.controller(cmd_vel_timeout=0)
        self.wait_for_level(DiagnosticStatus.OK, "stopped: no command yet")
        for _ in range(30):
            self.command(0.5)
            rospy.sleep(0.05)
        self.wait_for_level(DiagnosticStatus.OK, "driving")
        values = self.values()
        self.assertEqual((values["board"], values["bus"]), ("jetbot", f"fake:{self.bus}"))
        self.assertGreater(int(values["transfers"]), 10)
        self.assertEqual(values["failed transfers"], "0")
        self.assertLess(float(values["age of the last command (s)"]), 3)
        self.wait_for(lambda: self.values()["commands per second"] != "0.0", 5.0, "a rate of commands")

    def test_alarm_and_fault(self):
        self.controller(cmd_vel_timeout=0.2)
        self.command(0.5)
        self.wait_for_level(DiagnosticStatus.WARN, "stopped: no command for 0.2 s (repeat it: rostopic pub -r 10)")
        os.unlink(os.path.join(self.bus, "0x60"))
        self.wait_for_level(DiagnosticStatus.ERROR, f"stopped: no answer from 0x60 on fake:{self.bus}, trying again")
        power_on(self.bus)  # else the guard keeps trying for minutes
