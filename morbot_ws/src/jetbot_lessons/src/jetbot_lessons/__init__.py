"""What must be there after each lesson of docs/lessons.

A check is a function that returns None, or one sentence that says what is missing and what to do.
"""
