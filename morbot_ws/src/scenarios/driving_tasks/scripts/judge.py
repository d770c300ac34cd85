#!/usr/bin/env python3
"""Measures how a robot drives a task: rosrun driving_tasks judge.py TASK."""
