"""The rounds of chaos are drawn before they begin, so that a seed repeats them, also with fewer faults."""

import sys
from pathlib import Path

TESTS = Path(__file__).parents[1]
sys.path += [str(TESTS / "chaos"), str(TESTS / "ros")]
from plan import draw_scene  # noqa: E402


def test_a_seed_draws_the_same_rounds_however_many_are_played():
    assert draw_scene(7, 5)[1][:2] == draw_scene(7, 2)[1]
    assert draw_scene(7, 5) != draw_scene(8, 5)


def test_what_is_left_out_changes_nothing_else():
    plan = draw_scene(7, 1)[1][0]
    first, *others = plan.events
    assert plan.only(frozenset([first.number])) == plan._replace(events=(first,))
    assert plan.only(None) == plan
    assert [event.number for event in others] == list(range(2, len(others) + 2))
