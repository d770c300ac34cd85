"""The wheels stop when the node, or roslaunch above it, is asked to end, and while roslaunch is suspended."""

import signal

from harness import START_TIMEOUT, RobotTest, publishers

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)


class StopAtShutdown(RobotTest):
    def test_node(self):
        texts = self.status()
        for each in SIGNALS:
            node = self.controller(cmd_vel_timeout=0)
            self.drive_at(0.5)
            self.wait_for_status(texts, "driving")  # so that this node's statuses arrive
            node.send_signal(each)
            self.wait_for_stop(within=0.7)
            self.assertEqual(node.wait(START_TIMEOUT), 0)
            self.assertNotIn("/jetbot_controller", publishers("/rosout"))
            self.wait_for_status(texts, "stopped: the controller has ended")
            self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the node to unsubscribe")

    def test_roslaunch(self):
        for each in SIGNALS:
            launch = self.launch("workshop", "workshop_jetbot_controller.launch")
            self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
            launch.send_signal(each)
            self.wait_for_stop(within=0.7)
            launch.wait(START_TIMEOUT)

    def test_suspended_roslaunch(self):
        launch = self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        launch.send_signal(signal.SIGSTOP)
        self.wait_for_stop(within=0.7)
        self.wheels_stay(0, 0, for_seconds=0.5)
        launch.send_signal(signal.SIGCONT)
        self.wait_for_wheels(0.4, 0.6)
