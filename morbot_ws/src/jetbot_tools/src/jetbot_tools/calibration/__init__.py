"""Finds by questions and short motions how a robot is wired and how it drives: the controller's parameters."""
