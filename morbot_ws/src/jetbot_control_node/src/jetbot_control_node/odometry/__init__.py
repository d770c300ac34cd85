"""How the robot moves: what its wheels get, and where it is by that, or as its board measures it. Drives nothing."""
