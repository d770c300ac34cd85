"""Random programs do the same in the page and as Python: see differential.py."""

from differential import made_smaller, random_differences, report
from javascript import needs_node

pytestmark = needs_node


def test_500_random_programs_do_the_same_in_the_page_and_in_python():
    for name, *found in random_differences(seed=1, count=500):
        raise AssertionError(f"program {name}\n{report(*made_smaller(*found))}")
