#!/usr/bin/env python3
"""The workshop's launch file starts both nodes and passes its arguments on."""

from harness import START, RobotTest, main, wheel_speeds


class LaunchWorkshop(RobotTest):
    def test_drives_the_workshops_motion(self):
        self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for_wheels(0.4, 0.6, within=START)

    def test_passes_arguments_on(self):
        self.launch("workshop", "workshop_jetbot_controller.launch", "board:=waveshare", "max_speed:=2", "linear:=1.0",
                    "angular:=0.0")
        self.wait_for(lambda: wheel_speeds(self.bus, "waveshare") == (0.5, 0.5), START, "the Waveshare board's wheels")
        self.assertEqual(self.wheels(), (0, 0), "and not the Adafruit board's")


if __name__ == "__main__":
    main(LaunchWorkshop)
