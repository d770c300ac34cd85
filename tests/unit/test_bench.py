"""The benchmark's report tells what was measured."""

import sys
from pathlib import Path

import pytest

sys.path.append(str(Path(__file__).parents[2] / "bench"))

import report  # noqa: E402


@pytest.fixture
def figures():
    figures = report.Figures()
    for ours, script, floor in ((2, 30, 1), (4, 10, 1), (3, 20, 1)):
        for case in "10 Hz", "50 Hz":
            for name, value in zip(report.COLORS, (ours, script, floor)):
                figures.add("node", name, "delay (ms)", case, value)
                figures.add("node", name, "CPU (%)", case, 10 * value)
    return figures


def rows(table):
    return [[cell.strip() for cell in line.split("|")[1:-1]] for line in table.splitlines()[2:]]


def test_a_row_is_the_medians_and_their_ratios(figures):
    assert rows(report.table(figures.medians("node")))[0] == ["delay (ms)", "10 Hz", "3", "20", "1", "6.67", "3"]


def test_rows_of_a_quantity_stand_together(figures):
    assert [row[:2] for row in rows(report.table(figures.medians("node")))] == [
        ["delay (ms)", "10 Hz"], ["delay (ms)", "50 Hz"], ["CPU (%)", "10 Hz"], ["CPU (%)", "50 Hz"]]


def test_nothing_has_no_ratio():
    assert report.ratio(5, 0) == ""


@pytest.mark.parametrize("value, text", [(0, "0"), (0.3694, "0.369"), (11.56, "11.6"), (1155.6, "1,156"),
                                         (55_000.0, "55,000")])
def test_numbers_have_three_digits_and_no_exponent(value, text):
    assert report.number(value) == text


def test_what_failed_is_told_and_the_rest_is_kept(figures):
    figures.add("node", "floor", "memory (MiB)", "", 48)
    assert rows(report.table(figures.medians("node")))[-1] == ["memory (MiB)", "", "nan", "nan", "48", "nan", "nan"]
    page = report.text(figures, ["the script has died"], runs=3, check=(4, 503), pace=0.31)
    assert "Left out of one run: the script has died." in page


def test_the_page_names_the_machine_and_what_was_run(figures, monkeypatch):
    monkeypatch.setattr(report, "machine", lambda: "a Jetson Nano")
    page = report.text(figures, [], runs=3, check=(4, 503), pace=0.31)
    assert "a Jetson Nano; medians of 3 run(s)" in page
    assert "took 0.31 ms" in page
    assert "4 transfers, 503 bits" in page
    assert "## node\n\n|  |  | this driver |" in page
