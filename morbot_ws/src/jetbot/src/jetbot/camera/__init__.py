"""What the robot sees: the sources of pictures, the stream of JPEGs from one, and ``Camera``."""
