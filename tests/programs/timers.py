#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist

SPEEDS = [(0.3, 0), (0.4, 0.1), (-0.2, 0), (0.25, -0.1)]
count = 0


def tick(event):
    global count
    motion = Twist()
    if count < len(SPEEDS):
        motion.linear.x, motion.angular.z = SPEEDS[count]
    else:
        rospy.signal_shutdown("all driven")
    publisher.publish(motion)
    count += 1


rospy.init_node("timers")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.1)
rospy.Timer(rospy.Duration(0.5), tick)
rospy.on_shutdown(lambda: publisher.publish(Twist()))
rospy.spin()
