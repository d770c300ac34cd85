"""The codes that the cockpit prints: for a terminal of 80 columns, and as QR codes."""

import pytest

from jetbot_cockpit_server import handout
from jetbot_cockpit_server.access import make_grants

ROWS = ["110", "010", "001"]
MODULES = {"█": "00", "▀": "01", "▄": "10", " ": "11"}


@pytest.fixture
def cards(monkeypatch):
    monkeypatch.setattr(handout, "qr_rows", lambda text: ROWS * 11)
    return [handout.make_card(grant, "192.168.100.200", 8080) for grant in make_grants(3)]


def test_each_code_stands_behind_its_label_in_an_address_that_can_be_opened(cards):
    text = handout.text(cards)
    assert [text.count(card.url) for card in cards] == [1] * 4
    assert cards[0].url == f"http://192.168.100.200:8080/#{cards[0].grant.code}"
    assert text.index("teacher") < text.index("jetbot_01") < text.index("jetbot_03")


def test_two_stand_side_by_side_within_80_columns(cards):
    lines = handout.text(cards).splitlines()
    assert max(map(len, lines)) <= 80
    assert [line for line in lines if "jetbot_01" in line] == [line for line in lines if "jetbot_02" in line]
    assert not [line for line in lines if "teacher" in line and "jetbot_01" in line], "what pupils scan stands apart"


def test_a_long_name_has_a_row_of_its_own(monkeypatch):
    monkeypatch.setattr(handout, "qr_rows", lambda text: [])
    cards = [handout.make_card(grant, "x" * 60, 8080) for grant in make_grants(2)]
    assert handout.text(cards).count("http://") == 3


@pytest.mark.parametrize("colors", [False, True])
def test_the_blocks_are_the_modules_of_the_qr_code(monkeypatch, colors):
    monkeypatch.setattr(handout, "qr_rows", lambda text: ROWS)
    grant = make_grants(0)[0]
    lines = handout.text([handout.make_card(grant, "localhost", 80)], colors).splitlines()[2:4]
    if colors:  # ink on white instead of light on a dark terminal
        lines = [line[len("\x1b[30;107m"):-len("\x1b[0m")].translate(str.maketrans("█▀▄ ", " ▄▀█")) for line in lines]
    pairs = [[MODULES[block] for block in line.ljust(3)] for line in lines]
    assert ["".join(pair[half] for pair in row) for row in pairs for half in (0, 1)] == [*ROWS, "000"]


def test_without_segno_there_are_addresses_only(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "segno", None)
    card = handout.make_card(make_grants(0)[1], "localhost", 8080)
    assert card.rows == [] and card.url in handout.text([card])


def test_a_qr_code_is_a_square_of_modules():
    pytest.importorskip("segno")
    rows = handout.qr_rows("http://192.168.100.200:8080/#ABC234")
    assert {len(row) for row in rows} == {len(rows)} and set("".join(rows)) == {"0", "1"}


def test_the_page_draws_them_too(cards):
    message = handout.message(cards)
    assert message["type"] == "codes" and len(message["codes"]) == 4
    assert set(message["codes"][0]) == {"label", "role", "robot", "url", "code", "rows"}
