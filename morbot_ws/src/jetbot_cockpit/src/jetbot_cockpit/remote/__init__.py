"""Between the pages of a hub, on a teacher's computer, and the cockpits of its robots: no ROS here."""
