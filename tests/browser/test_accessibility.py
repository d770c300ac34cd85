"""Everybody can use the pages: by keys alone, with a screen reader, and as axe-core's rules ask for."""

from .accessibility import tree, violations
from .conftest import ROBOT


def test_the_pad_breaks_no_rule(page):
    page.wait_for_text("status", "stopped")
    assert violations(page) == []
    assert any(node.role == "combobox" and node.value == ROBOT for node in tree(page))
