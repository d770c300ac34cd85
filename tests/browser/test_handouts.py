"""The handouts on paper: one page each, on A4 and on Letter."""

import base64
import re
from pathlib import Path

import pytest

HANDOUTS = Path(__file__).parents[2] / "docs/handouts.html"
PAGE = re.compile(rb"/Type\s*/Page\b")


@pytest.mark.parametrize("width, height", [(8.27, 11.69), (8.5, 11.0)], ids=["A4", "Letter"])
def test_each_handout_is_printed_on_one_page(browsers, width, height):
    driver = browsers(1).driver
    driver.get(HANDOUTS.as_uri())
    printed = driver.execute_cdp_cmd("Page.printToPDF", {"paperWidth": width, "paperHeight": height})
    pages, handouts = PAGE.findall(base64.b64decode(printed["data"])), HANDOUTS.read_text().count("<section ")
    assert len(pages) == handouts
