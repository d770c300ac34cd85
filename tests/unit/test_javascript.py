"""What the page's scripts do that needs no browser: each file of tests/js, run by Node's own test runner."""

import pytest
from javascript import needs_node, node

from conftest import ROOT


@needs_node
@pytest.mark.parametrize("file", sorted(ROOT.glob("tests/js/*.test.js")), ids=lambda file: file.name)
def test_the_page(file):
    done = node(file)
    assert done.returncode == 0, done.stdout
    assert "pass 0\n" not in done.stdout, "no test ran"
