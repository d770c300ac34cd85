"""The simulated time advances in whole steps, and loses none."""

from simulation.step_clock import MAX_STEPS, STEP, StepClock

MS = 1_000_000
START = 5_000 * MS
DAY = 86_400_000 * MS


def test_each_10_ms_is_a_step_and_the_stamps_are_whole_steps_apart():
    clock = StepClock(START, DAY)
    assert [clock.update(START + now * MS, DAY + now * MS) for now in (9, 10, 19, 31, 60)] == [0, 1, 0, 2, 3]
    assert (clock.steps, clock.stamp) == (6, DAY + 60 * MS)
    assert STEP == 0.01


def test_the_loop_waits_for_whole_steps_since_the_start():
    clock = StepClock(START + 7 * MS, DAY)
    assert [clock.remaining(START + now * MS, 2) for now in (7, 8, 26, 27)] == [0.02, 0.019, 0.001, 0.02]


def test_a_pause_is_made_up_for_in_parts():
    clock = StepClock(START, DAY)
    parts = [clock.update(START + 2505 * MS, DAY + 2505 * MS) for _ in range(4)]
    assert parts == [MAX_STEPS, MAX_STEPS, 50, 0]
    assert clock.stamp == DAY + 2500 * MS


def test_the_stamps_follow_a_clock_that_is_set_and_no_small_difference():
    for change in (DAY, -DAY // 2):
        clock = StepClock(START, DAY)
        clock.update(START + 10 * MS, DAY + 900 * MS)
        assert clock.stamp == DAY + 10 * MS
        clock.update(START + 20 * MS, DAY + change)
        assert clock.stamp == DAY + change
        clock.update(START + 30 * MS, DAY + change + 11 * MS)
        assert clock.stamp == DAY + change + 10 * MS


def test_a_pause_is_no_clock_that_is_set():
    clock = StepClock(START, DAY)
    clock.update(START + 60_000 * MS, DAY + 60_000 * MS)
    assert clock.stamp == DAY + MAX_STEPS * 10 * MS
