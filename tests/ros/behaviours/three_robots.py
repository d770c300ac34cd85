"""Three simulated robots share one map; each obeys its own cmd_vel in SI units on its own fake bus, slowly too."""

import os

import rospkg
import rospy
import tf2_ros
from geometry_msgs.msg import Twist
from nav_msgs.msg import Odometry

from harness import START_TIMEOUT, RobotTest, twist

SI_UNITS = os.path.join(rospkg.RosPack().get_path("jetbot_control_node"), "config/si_units.yaml")
ROBOTS = {"red": (0.5, 0.3, 0.0), "green": (0.0, 0.0, 0.1), "blue": (-0.5, -0.3, -0.5)}  # y in m; m/s, rad/s


class ThreeRobots(RobotTest):
    def test_three_robots(self):
        odometry = {name: self.record(f"/{name}/odom", Odometry) for name in ROBOTS}
        commands = {name: rospy.Publisher(f"/{name}/cmd_vel", Twist, queue_size=1) for name in ROBOTS}
        frames = tf2_ros.Buffer()
        tf2_ros.TransformListener(frames)
        self.start("roslaunch", "simulation", "three_robots.launch", "rviz:=false", f"config:={SI_UNITS}",
                   env={**os.environ, "ROS_HOME": os.path.join(self.folder, "home")})
        for name, (y, _, _) in ROBOTS.items():
            self.wait_for(lambda name=name: frames.can_transform("map", f"{name}/left_wheel", rospy.Time()),
                          START_TIMEOUT, f"{name} on the map")
            where = frames.lookup_transform("map", f"{name}/base_link", rospy.Time()).transform.translation
            self.assertEqual((where.x, where.y, where.z), (0, y, 0.03))
        self.assertEqual(len({rospy.get_param(f"/{name}/robot_description") for name in ROBOTS}), 3, "colours")

        def driving():
            for name, (_, linear, angular) in ROBOTS.items():
                commands[name].publish(twist(linear, angular))
            velocities = {name: odometry[name][-1].twist.twist for name in ROBOTS if odometry[name]}
            return velocities.keys() == ROBOTS.keys() and all(
                abs(velocities[name].linear.x - linear) < 0.01 and abs(velocities[name].angular.z - angular) < 0.01
                for name, (_, linear, angular) in ROBOTS.items())

        self.wait_for(driving, START_TIMEOUT, "each robot's own velocity")
