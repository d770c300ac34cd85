"""Between a session and ROS: which robots there are, what they report, and what they are commanded."""
