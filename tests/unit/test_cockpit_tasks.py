"""Tasks from the page: who chooses one, when a robot is judged, and what a class keeps of it."""

import pytest
from cockpit_control import ADA, BOB, OWN, STOPPED, TEACHER, Cockpit

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


def judge(cockpit, client=TEACHER, robot="/red", task="metre"):
    """Press Judge me; return why that is refused, or ""."""
    answer = cockpit.do(client, Message("judge", robot, task=task))
    assert (answer["type"], answer["robot"]) == ("judge", robot) and bool(answer["request"]) != bool(answer["refusal"])
    return answer["refusal"]["text"] if answer["refusal"] else ""


def cancel(cockpit, client):
    cockpit.do(client, Message("judge", "/red", task=""))


def test_the_task_of_a_robot_that_is_put_back_ends(cockpit):
    judge(cockpit)
    cockpit.do(TEACHER, Message("reset", "/red"))
    assert cockpit.robots.judged == [("/red", "metre"), ("/red", "")]


def test_pupils_choose_what_a_teacher_has_switched_on(cockpit):
    assert offered(cockpit) == {"metre": False, "park": False}
    assert "not switched this task on" in judge(cockpit, ADA)
    assert "Only a teacher" in switch(cockpit, client=ADA)["text"]
    switch(cockpit)
    assert cockpit.control.check(cockpit.time) == [{"type": "tasks", "tasks": [
        {"name": "metre", "title": "One metre", "on": True}, {"name": "park", "title": "Into the gap", "on": False}]}]
    assert not judge(cockpit, ADA) and cockpit.robots.judged == [("/red", "metre")]
    switch(cockpit, on=False)
    assert "not switched this task on" in judge(cockpit, ADA)


@pytest.mark.parametrize("client, task, change, refusal", [
    (ADA, "park", lambda cockpit: None, "has not switched this task on"),
    (TEACHER, "<b>", lambda cockpit: None, "No judge"),
    (TEACHER, "metre", lambda cockpit: setattr(cockpit.robots, "offered", ()), "No judge"),
    (OWN, "metre", lambda cockpit: None, "only blue"),
    (ADA, "metre", lambda cockpit: cockpit.push(BOB), "pupil 2 drives red. Press Judge me again when red is free."),
    (ADA, "metre", lambda cockpit: cockpit.robots.change("/red", stopped=True), "emergency stop"),
    (ADA, "metre", lambda cockpit: cockpit.robots.change("/red", judged_elsewhere=True),
     "A judge in a terminal already judges red. When it has ended, press Judge me again."),
    (ADA, "metre", lambda cockpit: cockpit.robots.change("/red", simulated=False), "Only simulated robots"),
    (ADA, "metre", lambda cockpit: None, "was interrupted. Press Judge me again.")])
def test_why_a_robot_is_not_judged(cockpit, client, task, change, refusal):
    switch(cockpit)
    driver = change(cockpit) or cockpit.driver()
    cockpit.control.check(cockpit.time)
    cockpit.time += "interrupted" in refusal  # s in which the cockpit was frozen
    assert refusal in judge(cockpit, client, task=task)
    assert cockpit.robots.judged == [] and cockpit.driver() == driver


def test_each_request_has_a_word_of_its_own_which_the_judge_hears(cockpit):
    words = []
    for _ in range(2):
        answer = cockpit.do(TEACHER, JUDGE)
        assert answer["request"] == cockpit.robots.request
        words.append(answer["request"])
    assert words[0] != words[1]


def test_whoever_is_judged_has_the_robot_and_the_last_result_is_gone(cockpit):
    cockpit.robots.change("/red", task=DONE)
    cockpit.control.check(cockpit.time)
    assert not judge(cockpit)
    state = cockpit.control.state()["robots"]["/red"]
    assert (state["driver"]["id"], state["task"]) == (TEACHER.id, None)
    assert cockpit.drivers.held == ["/red"], "a program that drives it waits"
    assert "drives red" in cockpit.do(ADA, Message("drive", "/red", 0.5, 0.0))["text"]


def test_only_who_has_asked_for_it_ends_that_a_robot_is_judged(cockpit):
    switch(cockpit)
    judge(cockpit, ADA)
    for client in BOB, OWN, TEACHER:
        cancel(cockpit, client)
    assert cockpit.robots.judged == [("/red", "metre")]
    for _ in range(2):
        cancel(cockpit, ADA)
    assert cockpit.robots.judged[1:] == [("/red", "")]
    cockpit.do(ADA, Message("judge", "/other", task=""))
    assert cockpit.robots.judged[2:] == []


LOSSES = {
    "its page is closed": lambda cockpit: cockpit.control.leave(ADA.id),
    "a teacher takes the robot": lambda cockpit: cockpit.do(TEACHER, Message("take", "/red")),
    "all robots are stopped": lambda cockpit: cockpit.do(BOB, Message("stop")),
    "the page falls silent, though it is connected": lambda cockpit: cockpit.wait(5.1),
    "the page drives another robot": lambda cockpit: cockpit.push(ADA, "/blue"),
}


@pytest.mark.parametrize("drives", [False, True], ids=["before the drive", "while it drives"])
@pytest.mark.parametrize("lose", LOSSES.values(), ids=LOSSES)
def test_no_judge_goes_on_for_who_has_lost_the_robot(cockpit, lose, drives):
    switch(cockpit)
    judge(cockpit, ADA)
    if drives:
        cockpit.push(ADA, seconds=1)
    cockpit.wait(0.1)
    assert cockpit.robots.judged == [("/red", "metre")]
    lose(cockpit)
    cockpit.wait(0.1)
    assert cockpit.robots.judged == [("/red", "metre"), ("/red", "")] and cockpit.drives() == STOPPED


def test_who_waits_for_the_judge_keeps_the_robot(cockpit):
    switch(cockpit)
    judge(cockpit, ADA)
    for _ in range(20):
        cockpit.wait(1.0)
        cockpit.do(ADA, Message("program", "/red"))
    assert cockpit.robots.judged == [("/red", "metre")]
    assert "pupil 1 drives red." in judge(cockpit, BOB)


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
