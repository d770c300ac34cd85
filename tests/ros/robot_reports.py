"""A node that reports what the robot of tests/js/modules.test.js does, and obeys as that one does: not at all."""

import math

import rospy
from geometry_msgs.msg import Quaternion, Twist
from nav_msgs.msg import Odometry
from std_msgs.msg import Float32MultiArray

rospy.init_node("robot")
rospy.Subscriber("cmd_vel", Twist, queue_size=1)
odometry = rospy.Publisher("odom", Odometry, queue_size=1)
line = rospy.Publisher("line", Float32MultiArray, queue_size=1)
wheels = rospy.Publisher("jetbot_controller/wheels", Float32MultiArray, queue_size=1)
pose = Odometry(child_frame_id="base_footprint")
pose.header.frame_id = "odom"
pose.pose.pose.position.x, pose.pose.pose.position.y = 1, 2
pose.pose.pose.orientation = Quaternion(0, 0, math.sin(0.25), math.cos(0.25))
rate = rospy.Rate(20)
while not rospy.is_shutdown():
    pose.header.stamp = rospy.Time.now()
    odometry.publish(pose)
    line.publish(data=[0.25, 0.5, 1])
    wheels.publish(data=[0.375, 0.125, 0.25, 0.5])
    rate.sleep()
