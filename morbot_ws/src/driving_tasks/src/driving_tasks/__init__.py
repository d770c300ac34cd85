"""Driving tasks with a score."""
