"""The class's best."""

from jetbot_cockpit_server import scores
from jetbot_cockpit_server.scores import Scores
from jetbot_cockpit_server.task import Task

DONE = Task("metre", "One metre", "done", "", 4.0, 80.0)


def rows(messages):
    return [tuple(row.values()) for message in messages for row in message["scores"]]


def test_nothing_is_sent_before_the_first_score():
    best = Scores()
    assert best.update({"/red": None, "/blue": DONE._replace(state="driving", score=None)}) == best.messages() == []


def test_a_score_is_sent_once():
    best = Scores()
    assert best.update({"/red": DONE}) == best.messages() == [{"type": "scores", "scores": [
        {"task": "One metre", "robot": "red", "score": 80.0, "seconds": 4.0}]}]
    assert best.update({"/red": DONE}) == []


def test_the_best_of_each_robot_in_each_task_counts_the_shorter_time_if_equal():
    best = Scores()
    for task in (DONE, DONE._replace(score=70.0), DONE._replace(seconds=3.0), DONE._replace(seconds=None)):
        best.update({"/red": task})
    best.update({"/red": DONE._replace(name="circle", title="A circle")})
    assert rows(best.messages()) == [("A circle", "red", 80.0, 4.0), ("One metre", "red", 80.0, 3.0)]


def test_the_best_robot_of_a_task_comes_first_and_one_that_has_ended_stays():
    best = Scores()
    best.update({"/red": DONE, "/blue": DONE._replace(score=90.0), "/green": DONE._replace(seconds=3.0)})
    best.update({})
    assert [row[1] for row in rows(best.messages())] == ["blue", "green", "red"]


def test_there_are_at_most_so_many_and_the_oldest_are_dropped():
    best = Scores()
    for number in range(2 * scores.MAX_SCORES):
        best.update({f"/robot_{number}": DONE})
    left = {row[1] for row in rows(best.messages())}
    assert len(left) == scores.MAX_SCORES and f"robot_{number}" in left
