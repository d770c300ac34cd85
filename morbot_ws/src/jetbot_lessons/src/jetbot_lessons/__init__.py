"""Checks of a pupil's work after each lesson of docs/lessons.

A check returns the problem as one sentence that names the fix, or None.
"""

from typing import Optional

Problem = Optional[str]
