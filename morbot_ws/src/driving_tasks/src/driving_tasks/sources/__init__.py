"""Where the drives come from that are judged: a robot that drives now, a rosbag, or a program that is run."""
