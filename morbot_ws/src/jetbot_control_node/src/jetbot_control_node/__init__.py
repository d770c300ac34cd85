"""The controller: turns cmd_vel into wheel speeds, and stops the robot when it must not move."""
