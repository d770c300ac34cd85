"""The cockpit's server: web/ talks to browsers, robots/ to ROS, session/ decides who drives between them."""
