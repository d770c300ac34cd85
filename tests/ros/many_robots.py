#!/usr/bin/env python3
"""Thirty robots under one master, ten commands a second each: all obey, one emergency stop stops all, and
one that dies ends alone."""

import os
import signal
from pathlib import Path

import rospy
from geometry_msgs.msg import Twist

from harness import STILL, RobotTest, main, near, twist, wheel_speeds
from jetbot_lessons.graph import pid

ROBOTS = 30
START_OF_ALL = 60.0  # seconds; roslaunch starts one after the other


class ManyRobots(RobotTest):
    def test_thirty_robots(self):
        home = Path(self.folder, "home")
        speeds = {f"jetbot_{i:02}": i / 100 for i in range(1, ROBOTS + 1)}
        publishers = {name: rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1) for name in speeds}

        def command_all(_):
            for name, speed in speeds.items():
                publishers[name].publish(twist(speed))

        def wheels(name):
            return wheel_speeds(home / "fake_i2c" / name)

        def all_drive(wanted):
            return all(near(wheels(name), wanted(name)) for name in speeds)

        self.start("roslaunch", "jetbot_control_node", "many_robots.launch", f"robots:={ROBOTS}",
                   env={**os.environ, "ROS_HOME": str(home)})
        self.emergency_stop(False)
        self.wait_for(lambda: all(each.get_num_connections() for each in publishers.values())
                      and self._emergency.get_num_connections() == ROBOTS, START_OF_ALL, "all to subscribe")
        timer = rospy.Timer(rospy.Duration(0.1), command_all)
        self.addCleanup(timer.shutdown)
        self.wait_for(lambda: all_drive(lambda name: (speeds[name], speeds[name])), 5.0, "all to drive as they should")
        self.emergency_stop(True)
        self.wait_for(lambda: all_drive(lambda name: STILL), 0.5, "all to stop")
        os.kill(pid("/jetbot_07/jetbot_controller"), signal.SIGKILL)
        self.emergency_stop(False)
        others = speeds.keys() - {"jetbot_07"}
        self.wait_for(lambda: all(near(wheels(name), (speeds[name], speeds[name])) for name in others), 5.0,
                      "all others to drive on")


if __name__ == "__main__":
    main(ManyRobots)
