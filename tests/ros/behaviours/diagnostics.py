"""What the controller reports: why it is stopped, what its supply does, what its wheels get."""

import math
import os
import time

import rospy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus
from sensor_msgs.msg import BatteryState
from std_msgs.msg import Float32MultiArray

from harness import RobotTest, read
from jetbot.fake.bus import power_on

UNITS = "workshop units: left = x - z, right = x + z"


class Diagnostics(RobotTest):
    def setUp(self):
        super().setUp()
        self.arrays = self.record("/diagnostics", DiagnosticArray)

    def latest(self):
        return self.arrays[-1].status[0]

    def health(self):
        return self.arrays[-1].status[1]

    def values(self):
        return {pair.key: pair.value for pair in self.latest().values}

    def wait_for_level(self, level, status):
        wanted = level, status + self.hardware
        self.wait_for(lambda: self.arrays and (self.latest().level, self.latest().message) == wanted, 5.0,
                      f"{wanted} in /diagnostics")

    def test_levels_and_values(self):
        controller = self.controller(cmd_vel_timeout=0.4)
        self.wait_for_level(DiagnosticStatus.OK, "stopped: no command yet")
        self.wait_for(lambda: self.command(0.5) or self.latest().message == "driving" + self.hardware
                      and self.values()["commands per second"] != "0.0", 5.0, "/diagnostics of a robot that drives")
        values = self.values()
        texts = [values[name] for name in ("board", "bus", "units", "settings")]
        self.assertEqual(texts, ["jetbot", f"fake:{self.bus}", UNITS, "no file of settings"])
        self.assertEqual((values["wheel_separation"], values["max_speed"]), ("2.0", "1.0"))
        lines = read(controller).splitlines()
        self.assertIn(f"board jetbot on fake:{self.bus}; {UNITS}; no file of settings", lines[0])
        self.assertIn(": stopped: no command yet, on a fake bus", lines[1])
        self.assertGreater(int(values["transfers"]), 10)
        self.assertEqual(values["failed transfers"], "0")
        self.assertLess(float(values["age of the last command (s)"]), 3)
        self.wait_for_level(DiagnosticStatus.WARN, "stopped: no command for 0.4 s (repeat it: rostopic pub -r 10)")
        os.unlink(os.path.join(self.bus, "0x60"))
        self.wait_for_level(DiagnosticStatus.ERROR, f"stopped: no answer from 0x60 on fake:{self.bus}, trying again")
        power_on(self.bus)  # else the guard keeps trying for minutes

    def test_what_the_wheels_get_at_most_ten_times_a_second(self):
        self.controller(cmd_vel_timeout=0, left_motor_alpha=0.5)
        messages = self.record("/jetbot_controller/wheels", Float32MultiArray)
        self.wait_for(lambda: len(messages) > 1, 5.0, "two messages")
        self.assertEqual((list(messages[-1].data), messages[-1].layout.dim[0].label),
                         ([0, 0, 0, 0], "x, z, left, right"))
        del messages[:]
        start = time.monotonic()
        for step in range(100):
            self.command(0.5, step / 1000)
            rospy.sleep(0.01)
        self.wait_for(lambda: close(messages[-1].data, (0.5, 0.099, 0.2005, 0.599)), 5.0, "the last command's wheels")
        self.assertLessEqual(len(messages), 10 * (time.monotonic() - start) + 1)

    def test_supply(self):
        batteries = self.record("/battery", BatteryState)
        controller = self.controller(cmd_vel_timeout=0)
        self.wait_for(lambda: len(batteries) > 1, 5.0, "two messages of the battery")
        self.assertAlmostEqual(batteries[-1].voltage, 12.1, places=3)
        self.assertAlmostEqual(batteries[-1].percentage, (12.1 - 9.0) / 3.6, places=3)
        self.assertTrue(batteries[-1].present and math.isnan(batteries[-1].current))
        with open(os.path.join(self.bus, "0x41"), "r+b") as chip:
            chip.seek(4)
            chip.write(b"\x46\x50")  # 9.0 V
        empty = "Battery: 9.0 V, about 0 %. It is empty: charge it now."
        self.wait_for(lambda: (self.health().level, self.health().message) == (DiagnosticStatus.ERROR, empty), 5.0,
                      "an empty battery in /diagnostics")
        self.assertIn(empty, read(controller))
        self.assertEqual({pair.key for pair in self.health().values}, {"volts", "percent"}, "and of no real computer")
        os.unlink(os.path.join(self.bus, "0x41"))
        self.wait_for(lambda: math.isnan(batteries[-1].voltage), 5.0, "a battery without a voltage")
        self.wait_for(lambda: not self.health().values, 5.0, "no readings of it")


def close(values, wanted):
    return all(abs(value - want) < 0.001 for value, want in zip(values, wanted))
