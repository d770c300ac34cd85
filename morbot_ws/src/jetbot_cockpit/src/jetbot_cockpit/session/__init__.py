"""Who watches and who drives, and what each page is sent: no ROS, no sockets and no clock here."""
