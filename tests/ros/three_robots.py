#!/usr/bin/env python3
"""Three simulated robots in three namespaces share one map; each is driven by its own cmd_vel on its own fake bus."""

import os

import rospkg
import rospy
import tf2_ros
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from harness import START_TIMEOUT, RobotTest, main, twist

SI_UNITS = os.path.join(rospkg.RosPack().get_path("jetbot_control_node"), "config/si_units.yaml")
SPEEDS = {"red": (0.3, 0.0), "green": (0.0, 1.0), "blue": (-0.3, -0.5)}  # m/s, rad/s
STARTS = {"red": 0.5, "green": 0.0, "blue": -0.5}                        # y in metres


class ThreeRobots(RobotTest):
    def test_three_robots(self):
        velocities, publishers = {}, {}
        for name in SPEEDS:
            rospy.Subscriber(f"/{name}/odom", Odometry, self.keep_velocity, (velocities, name))
            publishers[name] = rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1)
        frames = tf2_ros.Buffer()
        tf2_ros.TransformListener(frames)
        self.start("roslaunch", "simulation", "three_robots.launch", "rviz:=false", f"config:={SI_UNITS}",
                   env={**os.environ, "ROS_HOME": os.path.join(self.folder, "home")})

        def driving():
            for name, (linear, angular) in SPEEDS.items():
                publishers[name].publish(twist(linear, angular))
            return velocities.keys() == SPEEDS.keys() and all(
                abs(velocities[name][0] - SPEEDS[name][0]) < 0.01 and abs(velocities[name][1] - SPEEDS[name][1]) < 0.05
                for name in SPEEDS)

        for name, y in STARTS.items():
            self.wait_for(lambda name=name: frames.can_transform("map", f"{name}/left_wheel", rospy.Time()),
                          START_TIMEOUT, f"{name} on the map")
            where = frames.lookup_transform("map", f"{name}/base_link", rospy.Time()).transform.translation
            self.assertEqual((where.x, where.y, where.z), (0, y, 0.03))
        self.wait_for(driving, START_TIMEOUT, f"each robot's own velocity; now {velocities}")

    def keep_velocity(self, odometry, velocities_and_name):
        velocities, name = velocities_and_name
        velocities[name] = odometry.twist.twist.linear.x, odometry.twist.twist.angular.z


if __name__ == "__main__":
    main(ThreeRobots)
