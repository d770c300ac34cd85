#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist


def ramp(top, steps):
    for step in range(1, steps + 1):
        yield top * (steps + step) / (2 * steps)


def plan():
    yield from ramp(0.5, 4)
    for speed in reversed(list(ramp(0.5, 4))):
        yield speed
    received = yield 0.2
    yield received or -0.3


rospy.init_node("generators")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
motion = Twist()
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
rate = rospy.Rate(5)  # begins with the drive
for motion.linear.x in plan():
    publisher.publish(motion)
    rate.sleep()
turns = sorted([0.2, -0.1, 0.15], key=lambda z: -z)
for motion.angular.z in (each for each in turns if each > 0):
    publisher.publish(motion)
    rate.sleep()
publisher.publish(Twist())
rate.sleep()
