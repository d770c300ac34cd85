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


def test_a_teacher_chooses_any_task_that_a_judge_has(cockpit):
    assert not judge(cockpit)
    assert "No judge" in judge(cockpit, task="<b>")
    cockpit.robots.offered = ()
    cockpit.control.check(cockpit.time)
    assert "No judge" in judge(cockpit) and offered(cockpit) == {}


def test_a_robot_is_judged_for_who_may_drive_it_now(cockpit):
    switch(cockpit)
    assert "only blue" in judge(cockpit, OWN)
    cockpit.push(BOB, "/red")
    assert judge(cockpit, ADA) == "pupil 2 drives red. Press Judge me again when red is free."
    cockpit.robots.change("/blue", stopped=True)
    cockpit.control.check(cockpit.time)
    assert "emergency stop" in judge(cockpit, OWN, "/blue")
    cockpit.time += 1
    assert "was interrupted. Press Judge me again." in judge(cockpit)
    assert cockpit.robots.judged == []


def test_a_robot_that_a_judge_in_a_terminal_judges_is_refused_and_nothing_is_asked(cockpit):
    cockpit.robots.change("/red", judged_elsewhere=True)
    cockpit.control.check(cockpit.time)
    assert judge(cockpit) == "A judge in a terminal already judges red. When it has ended, press Judge me again."
    assert cockpit.robots.judged == [] and cockpit.driver() is None


def test_a_program_that_drives_the_robot_waits(cockpit):
    judge(cockpit)
    assert cockpit.drivers.held == ["/red"]


def test_each_request_has_a_word_of_its_own_which_the_judge_hears(cockpit):
    words = []
    for _ in range(2):
        answer = cockpit.do(TEACHER, JUDGE)
        assert answer["request"] == cockpit.robots.request
        words.append(answer["request"])
    assert words[0] != words[1]


def test_a_real_robot_is_not_judged(cockpit):
    cockpit.robots.change("/red", simulated=False)
    cockpit.control.check(cockpit.time)
    assert "Only simulated robots" in judge(cockpit) and cockpit.robots.judged == []


def test_whoever_is_judged_has_the_robot_and_the_last_result_is_gone(cockpit):
    cockpit.robots.change("/red", task=DONE)
    cockpit.control.check(cockpit.time)
    assert not judge(cockpit)
    state = cockpit.control.state()["robots"]["/red"]
    assert (state["driver"]["id"], state["task"]) == (TEACHER.id, None)
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


def fall_silent(cockpit):
    cockpit.wait(5.1)


LOSSES = {
    "its page is closed": lambda cockpit: cockpit.control.leave(ADA.id),
    "a teacher takes the robot": lambda cockpit: cockpit.do(TEACHER, Message("take", "/red")),
    "all robots are stopped": lambda cockpit: cockpit.do(BOB, Message("stop")),
    "the page falls silent, though it is connected": fall_silent,
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


def test_of_two_pages_that_press_at_once_one_is_judged(cockpit):
    switch(cockpit)
    assert [judge(cockpit, ADA), judge(cockpit, BOB)] == [
        "", "pupil 1 drives red. Press Judge me again when red is free."]
    cancel(cockpit, BOB)
    cockpit.wait(0.1)
    assert cockpit.robots.judged == [("/red", "metre")]


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
