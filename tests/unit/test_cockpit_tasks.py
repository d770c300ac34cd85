"""Tasks from the page: who chooses one, when a robot is judged, and what a class keeps of it."""

import pytest
from cockpit_control import ADA, BOB, OWN, TEACHER, Cockpit

from jetbot_cockpit.session.history import Scores
from jetbot_cockpit.session.protocol import Message
from jetbot_cockpit.session.snapshot import TaskSnapshot

pytest_plugins = ["cockpit_control"]  # its fixtures
OFFERED = (("metre", "One metre"), ("park", "Into the gap"))
DONE = TaskSnapshot("metre", "One metre", "done", "Largest loss: too late.", 4.0, 80.0, "Ada")
JUDGE = Message("judge", "/red", task="metre")


@pytest.fixture
def cockpit(kept):
    return start(kept)


def start(kept):
    """Start a cockpit, with a judge, in which a teacher has switched a task on."""
    cockpit = Cockpit(folder=kept)
    cockpit.robots.offered = OFFERED
    cockpit.control.check(cockpit.time)
    return cockpit


def offered(cockpit):
    message, = [message for message in cockpit.control.history() if message["type"] == "tasks"]
    return {task["name"]: task["on"] for task in message["tasks"]}


def switch(cockpit, task="metre", on=True, client=TEACHER):
    return cockpit.do(client, Message("offer", task=task, on=on))


def test_pupils_choose_what_a_teacher_has_switched_on(cockpit):
    assert offered(cockpit) == {"metre": False, "park": False}
    assert "not switched this task on" in cockpit.do(ADA, JUDGE)["text"]
    assert "Only a teacher" in switch(cockpit, client=ADA)["text"]
    switch(cockpit)
    assert cockpit.control.check(cockpit.time) == [{"type": "tasks", "tasks": [
        {"name": "metre", "title": "One metre", "on": True}, {"name": "park", "title": "Into the gap", "on": False}]}]
    assert cockpit.do(ADA, JUDGE) is None and cockpit.robots.judged == [("/red", "metre")]
    switch(cockpit, on=False)
    assert cockpit.do(ADA, JUDGE) and cockpit.do(TEACHER, JUDGE)


def test_a_teacher_chooses_any_task_that_a_judge_has(cockpit):
    assert cockpit.do(TEACHER, JUDGE) is None
    assert "No judge" in cockpit.do(TEACHER, Message("judge", "/red", task="<b>"))["text"]
    cockpit.robots.offered = ()
    cockpit.control.check(cockpit.time)
    assert "No judge" in cockpit.do(TEACHER, JUDGE)["text"] and offered(cockpit) == {}


def test_a_robot_is_judged_for_who_may_drive_it_now(cockpit):
    switch(cockpit)
    assert "only blue" in cockpit.do(OWN, JUDGE)["text"]
    cockpit.push(BOB, "/red")
    assert "pupil 2 drives red" in cockpit.do(ADA, JUDGE)["text"]
    cockpit.robots.change("/blue", stopped=True)
    cockpit.control.check(cockpit.time)
    assert "emergency stop" in cockpit.do(OWN, Message("judge", "/blue", task="metre"))["text"]
    assert cockpit.robots.judged == []


def test_a_real_robot_is_not_judged(cockpit):
    cockpit.robots.change("/red", simulated=False)
    cockpit.control.check(cockpit.time)
    assert "Only simulated robots" in cockpit.do(TEACHER, JUDGE)["text"] and cockpit.robots.judged == []


def test_whoever_is_judged_has_the_robot_and_the_last_result_is_gone(cockpit):
    cockpit.robots.change("/red", task=DONE)
    cockpit.control.check(cockpit.time)
    assert cockpit.do(TEACHER, JUDGE) is None
    state = cockpit.control.state()["robots"]["/red"]
    assert (state["driver"]["id"], state["task"]) == (TEACHER.id, None)
    assert "drives red" in cockpit.do(ADA, Message("drive", "/red", 0.5, 0.0))["text"]


def test_only_who_drives_a_robot_ends_that_it_is_judged_also_by_leaving(cockpit):
    cockpit.do(TEACHER, JUDGE)
    end = Message("judge", "/red", task="")
    assert cockpit.do(ADA, end) is None and cockpit.do(OWN, end) is None
    assert cockpit.robots.judged == [("/red", "metre")]
    assert cockpit.do(TEACHER, end) is None and cockpit.robots.judged[1:] == [("/red", "")]
    cockpit.do(TEACHER, Message("judge", "/other", task=""))
    cockpit.control.leave(TEACHER.id)
    assert cockpit.robots.judged[2:] == [("/red", "")]


def test_a_class_keeps_its_tasks_and_best_scores(cockpit, kept):
    switch(cockpit, "park")
    cockpit.robots.change("/red", task=DONE)
    cockpit.control.check(cockpit.time)
    cockpit.settle()
    again = start(kept)
    assert offered(again) == {"metre": False, "park": True}
    assert [message["scores"] for message in again.control.history() if message["type"] == "scores"] == [
        [{"task": "One metre", "robot": "red", "score": 80.0, "seconds": 4.0, "name": "Ada"}]]


@pytest.mark.parametrize("damaged", [
    None, 7, [], ["/red"], [*"abcdefg"], ["/red", "metre", "M", "red", float("nan"), 1, ""],
    ["/red", "metre", "M", "red", True, 1, ""], [[], "metre", "M", "red", 1, 1, ""]])
def test_scores_that_are_damaged_are_left_out(damaged):
    good = ["/red", "metre", "One metre", "red", 80.0, None, ""]
    assert len(Scores([damaged, good]).messages()[0]["scores"]) == 1
