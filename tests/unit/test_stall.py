"""What the simulator reports of wheels that get too little power to turn."""

import pytest

from jetbot_control_node.notes import LASTING
from simulation.stall import StallReport

BOTH = "the wheels get 4.7 % of full power, too little to turn: raise min_duty, or lower pwm_frequency"


def reports(*moments, fixed_pwm=False):
    """Return what is reported at each of these moments, (time in s, left duty, right duty); 0: no stall."""
    report = StallReport()
    return [report.update({name: duty for name, duty in (("left", left), ("right", right)) if duty}, fixed_pwm, now)
            for now, left, right in moments]


@pytest.mark.parametrize("left, right, sentence", [
    (-0.5 * 0.1125 / 2 / 0.6, 0.5 * 0.1125 / 2 / 0.6, BOTH),
    (0.01, 0.047, BOTH),
    (-0.0002, 0, BOTH.replace("wheels get 4.7 %", "left wheel gets 0.02 %")),
    (0, 0.04, BOTH.replace("wheels get 4.7 %", "right wheel gets 4 %"))])
def test_a_stall_that_lasts_is_reported_with_advice(left, right, sentence):
    assert reports((0.0, left, right), (LASTING, left, right)) == [None, sentence]


def test_a_frequency_that_is_fixed_is_no_advice():
    assert reports((0.0, 0.04, 0), (1.0, 0.04, 0), fixed_pwm=True)[1].endswith("too little to turn: raise min_duty")


def test_a_stall_is_reported_once_and_again_when_it_returns():
    stall = 0.047, 0.047
    assert reports((0.0, *stall), (1.0, *stall), (2.0, 0.03, 0.03), (3.0, 0, 0), (4.0, *stall), (5.0, *stall)) == [
        None, BOTH, None, None, None, BOTH]


def test_another_wheel_that_stalls_is_reported():
    assert reports((0.0, 0.047, 0), (1.0, 0.047, 0), (2.0, 0.047, 0.047))[-1] == BOTH


def test_a_ramp_that_passes_through_the_dead_band_is_no_stall():
    assert reports((0.0, 0.01, 0.01), (LASTING - 0.1, 0.04, 0.04), (LASTING, 0, 0), (LASTING + 0.1, 0.01, 0.01)) == [
        None] * 4
