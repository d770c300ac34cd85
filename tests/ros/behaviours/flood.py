"""After 5 s of 1,000 commands per second on a 100 kHz bus, a stop is obeyed at once: no command waits in a queue."""

import time
from pathlib import Path

from harness import RobotTest
from jetbot.fake.bus import power_on


class Flood(RobotTest):
    def test_stop_after_a_flood(self):
        power_on(self.bus)
        Path(self.bus, "clock").write_text("100000")
        self.controller(cmd_vel_timeout=0)
        start = time.monotonic()
        for i in range(5000):
            self.command(0.3 + 0.4 * (i % 2), 0.1)
            time.sleep(max(0, start + i / 1000 - time.monotonic()))
        self.assertNotEqual(self.wheels(), (0, 0))
        self.command(0)
        self.wait_for_stop(within=0.1)
        self.wheels_stay(0, 0, for_seconds=0.5)
