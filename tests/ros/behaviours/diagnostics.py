"""/diagnostics reports what the robot does and why it is stopped."""

import os

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus

from harness import RobotTest, read
from jetbot.fake.bus import power_on

UNITS = "workshop units: left = x - z, right = x + z"


class Diagnostics(RobotTest):
    def setUp(self):
        super().setUp()
        self.arrays = self.record("/diagnostics", DiagnosticArray)

    def latest(self):
        return self.arrays[-1].status[0]

    def values(self):
        return {pair.key: pair.value for pair in self.latest().values}

    def wait_for_level(self, level, status):
        wanted = level, status + self.hardware
        self.wait_for(lambda: self.arrays and (self.latest().level, self.latest().message) == wanted, 5.0,
                      f"{wanted} in /diagnostics")

    def test_levels_and_values(self):
        controller = self.controller(cmd_vel_timeout=0)
        self.wait_for_level(DiagnosticStatus.OK, "stopped: no command yet")
        for _ in range(30):
            self.command(0.5)
            rospy.sleep(0.05)
        self.wait_for_level(DiagnosticStatus.OK, "driving")
        values = self.values()
        texts = [values[name] for name in ("board", "bus", "units", "settings")]
        self.assertEqual(texts, ["jetbot", f"fake:{self.bus}", UNITS, "no file of settings"])
        lines = read(controller).splitlines()
        self.assertIn(f"board jetbot on fake:{self.bus}; {UNITS}; no file of settings", lines[0])
        self.assertIn(": stopped: no command yet, on a fake bus", lines[1])
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
