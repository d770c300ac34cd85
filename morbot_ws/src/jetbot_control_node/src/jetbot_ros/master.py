"""The ROS master, without which rospy would wait forever."""

import sys

import rosgraph


def require_master() -> None:
    """End the program with one sentence if no ROS master answers."""
    if not rosgraph.is_master_online():
        sys.exit(f"No ROS master at {rosgraph.get_master_uri()}. Start one in another terminal: roscore")
