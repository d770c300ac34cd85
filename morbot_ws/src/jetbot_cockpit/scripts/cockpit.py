#!/usr/bin/env python3
"""ROS node: a web page that drives, watches and stops robots."""
