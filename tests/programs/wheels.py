#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist
from std_msgs.msg import Float32MultiArray


def wheels(message):
    heard.append(message.data[:2])


heard = []
rospy.init_node("wheels")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
rospy.Subscriber("jetbot_controller/wheels", Float32MultiArray, wheels)
rate = rospy.Rate(10)
while publisher.get_num_connections() == 0:
    rate.sleep()
motion = Twist()
for x, z in [(0.4, 0.0), (0.2, 0.1), (0.0, -0.2)]:
    motion.linear.x, motion.angular.z = x, z
    for _ in range(5):
        publisher.publish(motion)
        rate.sleep()
    left, right = heard[-1]
    print(f"{left:.1f} {right:.1f}")
publisher.publish(Twist())
rate.sleep()
