#!/usr/bin/env python3
"""Run one behaviour, a module in ``behaviours``, under rostest: behaviour.py NAME."""

import rospy
import rostest

name = rospy.myargv()[1]
rospy.init_node(f"test_{name}")
rostest.rosrun("jetbot_tests", name, f"behaviours.{name}")
