"""Decides whether, how fast and for whom the robot moves, and drives it: from a command to the Robot."""
