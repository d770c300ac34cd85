"""Which task of a robot the cockpit shows, and for how long; with a clock turned by hand."""

import pytest

from jetbot_cockpit_server.task import GONE_AFTER, SILENT_AFTER, Task, TaskTracker, decode

VALUES = {"state": "driving", "seconds": "3.4", "title": "One metre"}
READY, DRIVING, DONE, CANCELLED = (
    decode("metre", "a sentence", {**VALUES, "state": state, "score": "87.3"})
    for state in ("ready", "driving", "done", "cancelled"))


def tracker(task):
    """Return a tracker that was given the task at second 0."""
    tracker = TaskTracker()
    tracker.update(task, 0.0)
    return tracker


def test_a_judges_report():
    assert DRIVING == Task("metre", "One metre", "driving", "a sentence", 3.4, None)
    assert DONE.score == 87.3


@pytest.mark.parametrize("name, values", [("", VALUES), ("metre", {}), ("motors", {"state": "OK"})])
def test_another_programs_report_is_no_task(name, values):
    assert decode(name, "", values) is None


@pytest.mark.parametrize("text", ["nan", "inf", "-1", "100.1", "", "<b>", None])
def test_a_score_that_is_none_is_not_shown(text):
    assert decode("metre", "", {"state": "done", "score": text, "seconds": text and f"-{text}"})[4:] == (None, None)


def test_texts_are_cut_off_and_harmless():
    task = decode("x" * 1000, "a\nb" + "c" * 1000, {"state": "ready", "title": "\x1b[31m" * 100})
    assert len(task.name) == len(task.title) == 60 and len(task.text) == 200 and (task.title + task.text).isprintable()


@pytest.mark.parametrize("task", [READY, DRIVING, CANCELLED])
def test_a_killed_judges_task_is_gone_after_a_while(task):
    killed = tracker(task)
    assert killed.current(False, GONE_AFTER) == task
    assert killed.current(False, GONE_AFTER + 0.1) is None
    assert killed.current(True, GONE_AFTER + 0.2) is None, "another judge has come, and has not reported yet"


def test_a_frozen_judges_drive_is_gone_after_a_while_until_it_goes_on():
    frozen = tracker(DRIVING)
    assert frozen.current(True, SILENT_AFTER) == DRIVING
    assert frozen.current(True, SILENT_AFTER + 0.1) is None
    frozen.update(DRIVING._replace(seconds=4.0), 10.0)
    assert frozen.current(True, 10.0).seconds == 4.0


def test_a_judge_that_waits_may_wait_for_long():
    waiting = tracker(READY)
    assert waiting.current(True, 1000.0) == READY


def test_a_score_stays_until_the_next_task():
    done = tracker(DONE)
    assert done.current(False, 1000.0) == DONE
    done.update(READY, 1000.0)
    assert done.current(True, 1000.0) == READY


def test_a_score_stays_until_the_robot_is_put_back():
    done = tracker(DONE)
    done.forget_result()
    assert done.current(True, 0.1) is None


def test_a_task_begins_although_its_judge_puts_the_robot_to_the_start():
    ready = tracker(READY)
    ready.forget_result()
    assert ready.current(True, 0.1) == READY
