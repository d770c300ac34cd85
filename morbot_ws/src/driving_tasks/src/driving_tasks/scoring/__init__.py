"""The score of a drive, from its samples alone: no ROS, no clock, no matplotlib."""
