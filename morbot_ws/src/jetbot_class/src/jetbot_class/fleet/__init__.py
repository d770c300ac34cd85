"""./morbot fleet, on the teacher's computer: OpenSSH and git reach the robots; no ROS here."""
