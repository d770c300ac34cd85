"""What a page is sent of tasks: with each state, when it changes, and all of it to a page that opens later."""

from cockpit_control import TEACHER

from jetbot_cockpit_server.protocol import Reset
from jetbot_cockpit_server.scene import Shape
from jetbot_cockpit_server.task import Task

pytest_plugins = ["cockpit_control"]  # its fixtures

COURSE = Shape("course", 0.01, ((0.0, 0.0), (1.0, 0.0)))
DONE = Task("metre", "One metre", "done", "went well", 4.0, 80.0)


def task(cockpit):
    return cockpit.control.state()["robots"]["/red"]["task"]


def types(messages):
    return [(message["type"], message.get("robot")) for message in messages]


def test_a_task_its_course_and_its_score_reach_the_pages(cockpit):
    assert task(cockpit) is None
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0), task=DONE, shapes=(COURSE,))
    assert types(cockpit.wait(0.05)) == [("scene", "/red"), ("scores", None)]
    assert task(cockpit) == {"name": "metre", "title": "One metre", "state": "done", "text": "went well",
                             "seconds": 4.0, "score": 80.0}
    assert cockpit.wait(0.05) == []
    assert types(cockpit.control.history()) == [
        ("trail", "/red"), ("trail", "/blue"), ("scene", "/red"), ("scene", "/blue"), ("scores", None)]


def test_a_result_is_forgotten_when_the_robot_is_put_back(cockpit):
    cockpit.robots.change("/red", pose=(1.0, 0.0, 0.0), task=DONE)
    cockpit.wait(0.05)
    cockpit.do(TEACHER, Reset("/red"))
    assert task(cockpit), "it has not reached its start yet"
    cockpit.robots.change("/red", pose=(0.0, 0.0, 0.0))
    assert types(cockpit.wait(0.05)) == [("trail", "/red")]
    cockpit.wait(0.05)
    assert task(cockpit) is None
