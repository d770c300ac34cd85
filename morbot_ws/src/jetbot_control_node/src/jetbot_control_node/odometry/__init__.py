"""Where the robot is: as its board measures it, or by what its wheels are given. Drives nothing."""
