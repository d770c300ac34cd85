"""The robot recovers by itself from failed transfers, a brown-out and an unplugged board."""

import os
from pathlib import Path

from harness import RobotTest
from jetbot.fake.bus import power_on


class BusFaults(RobotTest):
    def setUp(self):
        super().setUp()
        self.controller(cmd_vel_timeout=0)
        self.texts = self.status()
        self.command(0.5)
        self.wait_for_status(self.texts, "driving")
        del self.texts[:-1]

    def fail_transfers(self, count):
        Path(self.bus, "0x60.fail").write_text(str(count))

    def test_one_failed_transfer_goes_unnoticed(self):
        self.fail_transfers(1)
        self.command(0.75)
        self.wait_for_wheels(0.75, 0.75, within=0.5)
        self.assertEqual(self.texts, ["driving, on a fake bus"])

    def test_forty_failed_transfers(self):
        self.fail_transfers(40)
        self.command(0.75)
        self.wait_for_status(self.texts, f"stopped: no answer from 0x60 on fake:{self.bus}, trying again")
        self.wait_for_wheels(0.75, 0.75, within=1.2)
        self.wait_for_status(self.texts, "driving")

    def test_brown_out_during_a_steady_command(self):
        power_on(self.bus)
        self.assertEqual(self.wheels(), (0, 0))
        self.wait_for_wheels(0.5, 0.5, within=0.8)

    def test_another_program_writes_to_the_chip(self):
        with open(os.path.join(self.bus, "0x60"), "r+b") as chip:
            chip.seek(0x06)
            chip.write(bytes([0, 0, 0, 0x10]) * 16)
        self.assertEqual(self.wheels(), (0, 0))
        self.wait_for_wheels(0.5, 0.5, within=0.8)

    def test_unplugged_for_three_seconds(self):
        os.unlink(os.path.join(self.bus, "0x60"))
        self.wait_for_status(self.texts, f"stopped: no answer from 0x60 on fake:{self.bus}, trying again")
        for step in range(30):
            self.command(0.3 + step / 100)
            self.wheels_stay(0, 0, for_seconds=0.1)
        power_on(self.bus)
        self.wait_for_wheels(0.59, 0.59, within=1.0)
        self.wait_for_status(self.texts, "driving")
        self.assertEqual(len(self.texts), 3, f"each reported once: {self.texts}")
