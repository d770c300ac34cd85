#!/usr/bin/env python3
import time

import rospy
from geometry_msgs.msg import Twist, Vector3

MOVES = {"forward": (0.5, 0, 0.6), "left": (0, 0.3, 0.4), "back": (-0.4, 0, 0.5), "curve": (0.35, 0.15, 0.7)}

rospy.init_node("dictionary")
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
while publisher.get_num_connections() == 0:
    time.sleep(0.1)
moves = dict(MOVES)
moves["again"] = moves.pop("left")
moves.update(right=(0, -0.25, 0.4))
for name, (x, z, seconds) in moves.items():
    print(f"{name:>8}: {x:+.2f} {z:+.2f} for {seconds} s")
    publisher.publish(Twist(linear=Vector3(x=x), angular=Vector3(z=z)))
    time.sleep(seconds)
publisher.publish(Twist())
time.sleep(0.1)
