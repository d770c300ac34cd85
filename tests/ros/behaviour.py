#!/usr/bin/env python3
"""Run one behaviour, a module in ``behaviours``, under rostest: behaviour.py NAME.

With --master, below a ROS master of its own, in this process: rosmaster would take half a second of CPU time.
"""

import os
import sys

import rospy
import rostest
from rosmaster.master import Master

if "--master" in sys.argv:
    master = Master(0)
    master.start()
    os.environ["ROS_MASTER_URI"] = f"http://localhost:{master.master_node.port}"
name = rospy.myargv()[1]
rospy.init_node(f"test_{name}")
rostest.rosrun("jetbot_tests", name, f"behaviours.{name}")
