"""The first lessons; in a file of their own, so that two workers share the pages."""

from pupil import LESSONS, follow


def test_first_lessons(tmp_path):
    follow(LESSONS[:6], tmp_path)
