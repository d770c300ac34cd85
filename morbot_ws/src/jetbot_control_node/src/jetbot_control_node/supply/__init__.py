"""The supply of a robot, if anything measures it: read, watched, published."""
