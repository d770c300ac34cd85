"""Random programs of blocks do the same in the page and as Python: see differential.py."""

from differential import check
from javascript import needs_node

pytestmark = needs_node


def test_500_random_programs_do_the_same_in_the_page_and_in_python():
    check("blocks", seed=1, count=500)
