"""The first lessons; apart from the other pages, so that two workers share them."""

from pupil import LESSONS, follow


def test_first_lessons(tmp_path):
    follow(LESSONS[:6], tmp_path)
