"""The wheels stop when the controller, or roslaunch above it, is asked to end, killed or frozen."""

import contextlib
import os
import signal
from pathlib import Path

from harness import START_TIMEOUT, RobotTest, pid, publishers, read

SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
STOP_TIMEOUT = 1.5  # s, from the failure to the stop


class Crash(RobotTest):
    def driving_controller(self):
        """Start a controller that drives until something fails."""
        node = self.controller(cmd_vel_timeout=0)
        self.drive_at(0.5)
        return node

    def guards(self, node):
        """Return the process ids of a node's guards."""
        return [child for file in Path(f"/proc/{node.pid}/task").glob("*/children")
                for child in map(int, file.read_text().split()) if name_of(child) == "jetbot_guard"]

    def launched_workshop(self):
        """Start the workshop's launch file; wait until its robot drives."""
        launch = self.launch("workshop", "workshop_jetbot_controller.launch")
        self.wait_for_wheels(0.4, 0.6, within=START_TIMEOUT)
        return launch

    def test_the_node_is_asked_to_end(self):
        texts = self.status()
        for each in SIGNALS:
            node = self.driving_controller()
            self.wait_for_status(texts, "driving")  # so that this node's statuses arrive
            node.send_signal(each)
            self.wait_for_stop(within=0.7)
            self.assertEqual(node.wait(START_TIMEOUT), 0)
            self.assertNotIn("/jetbot_controller", publishers("/rosout"))
            self.wait_for_status(texts, "stopped: the controller has ended")
            self.wait_for(lambda: not self.commands().get_num_connections(), 5.0, "the node to unsubscribe")

    def test_roslaunch_is_suspended_and_then_asked_to_end(self):
        launch = self.launched_workshop()
        launch.send_signal(signal.SIGSTOP)
        self.wait_for_stop(within=0.7)
        self.wheels_stay(0, 0, for_seconds=0.5)
        launch.send_signal(signal.SIGCONT)
        self.wait_for_wheels(0.4, 0.6)
        launch.send_signal(signal.SIGHUP)
        self.wait_for_stop(within=0.7)
        launch.wait(START_TIMEOUT)

    def test_killed_below_roslaunch(self):
        launch = self.launched_workshop()
        os.kill(pid("/jetbot_controller"), signal.SIGKILL)
        self.wait_for_stop(within=STOP_TIMEOUT)
        self.wheels_stay(0, 0, for_seconds=1)
        launch.wait(START_TIMEOUT)

    def test_killed_without_roslaunch_after_its_guard(self):
        node = self.driving_controller()
        self.wait_for(lambda: self.guards(node), START_TIMEOUT, "the guard")
        first = self.guards(node)
        os.kill(*first, signal.SIGKILL)
        self.wait_for(lambda: set(self.guards(node)) - set(first), 2.0, "another guard")
        os.killpg(node.pid, signal.SIGKILL)
        self.wait_for_stop(within=STOP_TIMEOUT)

    def test_killed_while_its_board_is_unplugged(self):
        node = self.driving_controller()
        os.rename(self.bus + "/0x60", self.bus + "/unplugged")
        os.killpg(node.pid, signal.SIGKILL)
        node.wait()
        self.wait_for(lambda: "the wheels may still turn" in read(node), START_TIMEOUT, "the guard to miss the board")
        os.rename(self.bus + "/unplugged", self.bus + "/0x60")
        self.wait_for_stop(within=STOP_TIMEOUT)

    def test_roslaunch_itself_killed(self):
        launch = self.launch("simulation", "simulation.launch", "cmd_vel_timeout:=0", "rviz:=false")
        self.wait_for_controller()
        nodes = "/jetbot_controller", "/jetbot_simulator", "/robot_state_publisher"
        self.wait_for(lambda: all(map(pid, nodes)), START_TIMEOUT, "all nodes")
        self.drive_at(0.5)
        launch.kill()
        self.wait_for_stop(within=STOP_TIMEOUT)
        for node in nodes:
            self.wait_for(lambda node=node: pid(node) is None, START_TIMEOUT, f"{node} to end, too")


def name_of(process):
    """Return the name of a process; None for one that has just ended."""
    with contextlib.suppress(OSError):
        return Path(f"/proc/{process}/comm").read_text().strip()
