"""A class of real robots: what is typed on a robot, and on the teacher's computer."""
