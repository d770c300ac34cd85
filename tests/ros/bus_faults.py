#!/usr/bin/env python3
"""The robot recovers by itself from failed transfers, a brown-out and an unplugged board."""

from pathlib import Path

from harness import RobotTest, main
from jetbot.fake.bus import power_on


class BusFaults(RobotTest):
    def setUp(self):
        super().setUp()
        self.controller(cmd_vel_timeout=0)
        self.texts = self.status()
        self.command(0.5)
        self.wait_for_status(self.texts, "driving")
        del self.texts[:-1]

    def test_one_failed_transfer_goes_unnoticed(self):
        Path(self.bus, "0x60.fail").write_text("1")
        self.command(0.75)
        self.wait_for_wheels(0.75, 0.75, within=0.5)
        self.assertEqual(self.texts, ["driving"])

    def test_unplugged_for_three_seconds(self):
        Path(self.bus, "0x60").unlink()
        self.wait_for_status(self.texts, f"stopped: no answer from 0x60 on fake:{self.bus}, trying again")
        for step in range(30):
            self.command(0.3 + step / 100)
            self.wheels_stay(0, 0, for_seconds=0.1)
        power_on(self.bus)
        self.wait_for_wheels(0.59, 0.59, within=1.0)
        self.wait_for_status(self.texts, "driving")
        self.assertEqual(len(self.texts), 3, f"each reported once: {self.texts}")


if __name__ == "__main__":
    main(BusFaults)
