"""What a page is sent of trails, scenes and scores: when they change, and all of it to a page that opens later."""

import pytest

from jetbot_cockpit.session.history import JUMP, MAX_POINTS, MAX_SPEED, RESET_TIME, History
from jetbot_cockpit.session.snapshot import RobotSnapshot, Shape, TaskSnapshot

COURSE = Shape("course", 0.01, ((0.0, 0.0), (1.0, 0.0)))
SCENE = {"type": "scene", "robot": "/red", "shapes": [{"kind": "course", "width": 0.01, "points": COURSE.points}]}
NEW_TRAIL = {"type": "trail", "robot": "/red", "start": [0.0, 0.0, 0.0], "points": []}
DONE = TaskSnapshot("metre", "One metre", "done", "went well", 4.0, 80.0)


@pytest.fixture
def history():
    return History()


def at(x, name="/red", **fields):
    return RobotSnapshot(name, pose=(x, 0.0, 0.0), **fields)


def update(history, *robots, now=0.0):
    return history.update({robot.id: robot for robot in robots}, now)


def of_type(kind, history):
    return [message for message in history.messages() if message["type"] == kind]


def points(history):
    return {message["robot"]: message["points"] for message in of_type("trail", history)}


def rows(history):
    return [tuple(row.values())[:4] for message in of_type("scores", history) for row in message["scores"]]


def test_a_robot_that_drives_leaves_a_trail_and_one_that_stands_a_point(history):
    for number in range(11):
        assert update(history, at(0.01 * number), at(2.0, "/blue"), RobotSnapshot("/new"), now=0.05 * number) == []
    assert len(points(history)["/red"]) == 4
    assert (points(history)["/blue"], points(history)["/new"]) == ([[2, 0]], [])


def test_a_robot_that_is_put_somewhere_else_starts_its_trail_again(history):
    update(history, at(1.0))
    assert update(history, at(0.0), now=0.05) == [NEW_TRAIL]
    assert points(history) == {"/red": [[0, 0]]}


@pytest.mark.parametrize("state, shown", [("ready", True), ("driving", True), ("done", False), ("cancelled", True)])
def test_a_score_and_its_course_are_forgotten_when_the_robot_is_put_back_and_a_task_begins(history, state, shown):
    task = DONE._replace(state=state, score=80.0 if state == "done" else None)
    update(history, at(1.0, task=task, shapes=(COURSE,)))
    assert history.task(at(1.0, task=task)) == task
    update(history, at(0.0, task=task, shapes=(COURSE,)), now=0.05)
    assert history.task(at(0.0, task=task)) == (task if shown else None)
    assert [message["shapes"] for message in of_type("scene", history)] == [SCENE["shapes"] if shown else []]
    assert history.task(at(0.0, task=DONE._replace(seconds=9.0))), "the next one"


def test_a_robot_that_is_put_back_near_its_start_starts_again_once_it_is_there(history):
    update(history, at(0.1))
    for name in "/red", "/ended":
        history.reset(name, now=0.1)
    assert update(history, at(0.1), now=0.15) == update(history, at(0.0), now=0.2) == []
    assert update(history, at(0.0), now=0.1 + RESET_TIME) == [NEW_TRAIL]
    assert points(history) == {"/red": [[0, 0]]}
    assert update(history, at(0.1), now=1.0) == []


def test_a_page_that_opens_later_learns_where_a_robot_started_or_was_put_however_far_it_has_driven(history):
    def start():
        return of_type("trail", history)[0]["start"]
    update(history, RobotSnapshot("/red"))
    assert start() is None
    for number in range(1000):
        update(history, at(7.0 + 0.05 * number), now=0.05 * number)
    assert start() == [7.0, 0.0, 0.0]
    update(history, at(0.0), now=50.0)
    assert start() == [0.0, 0.0, 0.0]


def test_a_robot_that_drives_on_while_nobody_looks_keeps_its_trail(history):
    update(history, at(0.0))
    assert update(history, at(JUMP + MAX_SPEED * 1.4 - 0.01), now=1.4) == []


def test_the_oldest_points_are_dropped_and_robots_that_ended_too(history):
    for number in range(1000):
        update(history, at(0.05 * number), now=0.05 * number)
    assert len(points(history)["/red"]) == MAX_POINTS
    update(history)
    assert history.messages() == []


def test_a_scene_is_sent_when_it_changes_and_not_otherwise(history):
    course, empty = RobotSnapshot("/red", shapes=(COURSE,), task=DONE._replace(score=None)), {**SCENE, "shapes": []}
    assert update(history, course) == [SCENE] and update(history, course) == []
    assert update(history, RobotSnapshot("/red")) == [empty]
    assert of_type("scene", history) == [empty], "a page may have missed that nothing is there"
    update(history)
    assert update(history, course) == [SCENE]


def test_a_score_is_sent_once_and_nothing_before_the_first(history):
    assert update(history, RobotSnapshot("/red", task=DONE._replace(state="driving", score=None))) == []
    assert not of_type("scores", history)
    scores = {"type": "scores", "scores": [{"task": "One metre", "robot": "red", "score": 80.0, "seconds": 4.0,
                                               "name": "Ada"}]}
    driven = RobotSnapshot("/red", task=DONE._replace(driver="Ada"))
    assert update(history, driven) == of_type("scores", history) == [scores]
    assert update(history, driven) == []


def test_of_a_robots_scores_in_a_task_the_best_counts_and_the_shorter_time_of_equal_ones(history):
    for task in (DONE, DONE._replace(score=70.0), DONE._replace(seconds=3.0), DONE._replace(seconds=None),
                 DONE._replace(name="circle", title="A circle")):
        update(history, RobotSnapshot("/red", task=task))
    assert rows(history) == [("A circle", "red", 80.0, 4.0), ("One metre", "red", 80.0, 3.0)]


def test_the_best_robot_of_a_task_comes_first_and_one_that_has_ended_stays(history):
    update(history, RobotSnapshot("/red", task=DONE), RobotSnapshot("/blue", task=DONE._replace(score=90.0)),
           RobotSnapshot("/green", task=DONE._replace(seconds=3.0)))
    update(history)
    assert [row[1] for row in rows(history)] == ["blue", "green", "red"]
