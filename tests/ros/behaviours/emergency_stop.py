"""An emergency stop holds every robot, also one started later, until it is released and a new command arrives."""

import os
import signal
import socket
import time

import rospy
from diagnostic_msgs.msg import DiagnosticStatus, KeyValue
from std_msgs.msg import Bool, String

from harness import START_TIMEOUT, RobotTest, program, publishers, read


class EmergencyStop(RobotTest):
    def commands_are_ignored(self, for_seconds):
        for _ in range(int(for_seconds / 0.05)):
            self.command(0.5)
            self.wheels_stay(0, 0, for_seconds=0.05)

    def test_in_the_middle_of_a_gentle_start(self):
        self.controller(cmd_vel_timeout=0, acceleration_limit=0.5)
        self.command(0.8, 0.2)
        self.wait_for(lambda: self.wheels() != (0, 0), 5.0, "a start")
        start = time.monotonic()
        self.wait_for(lambda: self.wheels()[1] > 0.3, 5.0, "more speed")
        self.assertGreater(time.monotonic() - start, 0.3)
        left, right = self.wheels()
        self.assertAlmostEqual(left / right, 0.6, delta=0.03)
        self.emergency_stop(True)
        self.wait_for_stop(within=0.2)
        self.commands_are_ignored(for_seconds=0.2)

    def test_its_own_emergency_stop_holds_it_beside_that_of_all(self):
        self.controller(cmd_vel_timeout=0)
        texts = self.status()
        own = rospy.Publisher("/jetbot_controller/emergency_stop", Bool, queue_size=1, latch=True)
        self.addCleanup(own.unregister)
        self.drive_at(0.5)
        own.publish(True)
        self.wait_for_stop(within=1.0)
        self.wait_for_status(texts, "stopped: its own emergency stop")
        self.emergency_stop(True)
        self.wait_for_status(texts, "stopped: emergency stop")
        self.emergency_stop(False)
        self.wait_for_status(texts, "stopped: its own emergency stop")
        self.commands_are_ignored(for_seconds=0.3)
        own.publish(False)
        self.wait_for_status(texts, "stopped: no command since its own emergency stop was released")
        self.drive_at(0.25)

    def test_a_latched_stop_reaches_a_joining_robot_before_any_command(self):
        self.emergency_stop(True)
        texts = self.status()
        self.commands()
        commands = rospy.Timer(rospy.Duration(0.01), lambda _: self.command(0.5))
        self.addCleanup(commands.shutdown)
        self.controller()
        self.wait_for_status(texts, "stopped: emergency stop")
        self.wheels_stay(0, 0, for_seconds=1.0)

    def test_an_older_release_that_arrives_late_does_not_free_a_joining_robot(self):
        release = self.start("rostopic", "pub", "/emergency_stop", "std_msgs/Bool", "false")
        self.wait_for(lambda: len(publishers("/emergency_stop")) == 2, START_TIMEOUT, "the release")
        self.emergency_stop(True)
        os.killpg(release.pid, signal.SIGSTOP)
        self.controller()
        os.killpg(release.pid, signal.SIGCONT)
        self.commands_are_ignored(for_seconds=1.5)

    def test_a_program_whose_connection_breaks_off_stops_it_again_but_repeats_no_release(self):
        self.controller(cmd_vel_timeout=0)
        texts = self.status()
        self.emergency_stop(False)
        self.stop_by_hand()
        before = set(self._emergency.impl.connections)
        for connection in before:
            connection.socket.shutdown(socket.SHUT_RDWR)
        self.wait_for(lambda: set(self._emergency.impl.connections) - before, 5.0, "a new connection")
        self.commands_are_ignored(for_seconds=0.3)
        self.emergency_stop(False)
        self.wait_for_status(texts, "stopped: no command since the emergency stop was released")
        self.drive_at(0.5)
        self.emergency_stop(True)
        self.wait_for_stop(within=0.2)

    def stop_by_hand(self, *arguments):
        """Run the script; return its exit code and its output."""
        script = self.start(program("jetbot_tools", "emergency_stop.py"), *arguments)
        return script.wait(START_TIMEOUT), read(script)

    def test_by_hand_it_outlives_the_script_and_every_robot_confirms_it(self):
        self.controller(cmd_vel_timeout=0)
        texts = self.status()
        self.drive_at(0.5)
        code, printed = self.stop_by_hand()
        self.assertEqual(code, 0)
        self.assertTrue(printed.startswith("/jetbot_controller: stopped: emergency stop"), printed)
        self.commands_are_ignored(for_seconds=0.3)
        code, printed = self.stop_by_hand("--release")
        self.assertEqual(code, 0)
        self.assertNotIn("stopped: emergency stop", printed)
        self.wait_for_status(texts, "stopped: no command since the emergency stop was released")
        self.wheels_stay(0, 0, for_seconds=0.3)
        self.drive_at(0.25)

    def test_by_hand_a_robot_that_is_frozen_or_drives_on_is_named_and_a_dead_one_is_not(self):
        status = rospy.Publisher("~status", String, queue_size=1, latch=True)
        state = rospy.Publisher("~state", DiagnosticStatus, queue_size=1, latch=True)
        self.record("/emergency_stop", Bool)
        status.publish("driving")
        state.publish(DiagnosticStatus(message="driving", values=[KeyValue("state", "driving")]))
        node = self.controller()
        node.send_signal(signal.SIGSTOP)
        code, printed = self.stop_by_hand()
        self.assertEqual((code, printed.splitlines()[:2]), (1, [
            "/jetbot_controller: no answer (not confirmed)", f"{rospy.get_name()}: driving (not confirmed)"]))
        node.kill()
        node.wait()
        status.unregister()
        state.unregister()
        code, printed = self.stop_by_hand()
        self.assertEqual(code, 1)
        self.assertTrue(printed.startswith("No robot runs on the ROS master at "), printed)
