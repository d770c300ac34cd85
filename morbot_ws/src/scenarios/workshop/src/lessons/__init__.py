"""What must be there after each lesson of docs/lessons.

A check is a function that returns None, or one sentence that says what is missing and what to do.
"""

from .table import LAST, first_missing, needs_package

__all__ = ["LAST", "first_missing", "needs_package"]
