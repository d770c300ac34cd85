"""What ROS makes of the jetbot package, where a script would grow too long."""
