"""The ROS master, without which rospy would wait for ever."""

import sys

import rosgraph


def require_master():
    """Go on where a master answers; end the program with one sentence where none does."""
    if not rosgraph.is_master_online():
        sys.exit(f"No ROS master at {rosgraph.get_master_uri()}. Start one in another terminal: roscore")
