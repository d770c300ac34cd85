"""What other programs report about a robot: what a page cannot show is left out, and what is over disappears."""

import math
from types import SimpleNamespace as Message

import pytest

from jetbot.sentence import Sentence, dump
from jetbot_cockpit.robots import reports
from jetbot_cockpit.robots.reports import GONE_AFTER, SILENT_AFTER, TaskTracker, decode_task, program
from jetbot_cockpit.robots.reports import decode_shapes as decode
from jetbot_cockpit.session.snapshot import Shape, TaskSnapshot

VALUES = {"state": "driving", "seconds": "3.4", "title": "One metre"}
READY, DRIVING, DONE, CANCELLED = (
    decode_task("metre", "a sentence", {**VALUES, "state": state, "score": "87.3", "driver": "Ada", "request": "one"})
    for state in ("ready", "driving", "done", "cancelled"))
WALL = Shape("wall", 0.01, ((1.0, 0.0), (1.0, 2.0)))
WALL_TOUCHED = Sentence("wall", "touched a wall {times} times", {"times": "3"})


def same(_, pose):
    return pose


def marker(ns="walls", points=((1, 0), (1, 2)), pose=(0, 0, 0), width=0.01, action=reports.ADD,
           kind=reports.LINE_STRIP):
    x, y, yaw = pose
    return Message(
        header=Message(frame_id="map"), ns=ns, type=kind, action=action, scale=Message(x=width),
        pose=Message(position=Message(x=x, y=y), orientation=Message(z=math.sin(yaw / 2), w=math.cos(yaw / 2))),
        points=[Message(x=x, y=y) for x, y in points])


def test_polylines_are_drawn_where_they_are():
    assert decode([marker(), marker("lines", width=0.025), marker("course")], same) == (
        WALL, WALL._replace(kind="line", width=0.025), WALL._replace(kind="course"))


def test_a_markers_pose_and_its_frame_move_it():
    turned = marker(pose=(1, 0, math.pi / 2))
    assert decode([turned], same)[0].points == ((1.0, 1.0), (-1.0, 1.0))
    assert decode([marker()], lambda frame, pose: pose._replace(x=5.0))[0].points == ((6.0, 0.0), (6.0, 2.0))


def test_a_goal_is_an_arrow_from_its_place_in_its_direction():
    goal = marker("goal", points=(), pose=(1, 0.5, math.pi / 2), kind=reports.ARROW)
    assert decode([goal], same)[0].points == ((1.0, 0.5), (1.0, 0.6))


@pytest.mark.parametrize("changes", [
    {"ns": "robots"}, {"kind": 1}, {"kind": reports.ARROW}, {"action": 3}, {"points": ()}, {"points": ((0, 0),)},
    {"points": ((0, math.nan), (1, 1))}, {"points": ((0, 0), (math.inf, 1))}, {"points": ((0, 0), (1e9, 1))},
    {"pose": (math.nan, 0, 0)}, {"pose": (0, 0, math.nan)}, {"width": math.nan},
    {"points": ((0, 0),) * (reports.MAX_POINTS + 1)}], ids=str)
def test_what_no_map_shows_is_left_out_and_the_rest_is_drawn(changes):
    assert decode([marker(**changes), marker()], same) == (WALL,)


def test_there_are_at_most_so_many_points():
    assert sum(len(shape.points) for shape in decode([marker()] * 10000, same)) == reports.MAX_POINTS
    goals = [marker("goal", (), kind=reports.ARROW)] * 10000
    assert sum(len(shape.points) for shape in decode(goals, same)) == reports.MAX_POINTS


def tracker(task):
    """Return a tracker that was given the task at second 0."""
    tracker = TaskTracker()
    tracker.update(task, 0.0)
    return tracker


@pytest.mark.parametrize("text, sentences", [(dump([WALL_TOUCHED]), (WALL_TOUCHED,)), ("no data", ())])
def test_a_judges_sentences_are_data_that_a_page_translates_besides_its_english(text, sentences):
    task = decode_task("metre", "in English", {**VALUES, "sentences": text, "lost": "60.0"})
    assert (task.text, task.lost, task.sentences) == ("in English", 60.0, sentences)
    assert task.message()["sentences"] == [each._asdict() for each in sentences]


def test_a_loss_may_be_larger_than_the_score():
    assert decode_task("park", "", {"state": "done", "lost": "120.0"}).lost == 120.0


def test_a_judges_report():
    assert DRIVING == TaskSnapshot("metre", "One metre", "driving", "a sentence", 3.4, None, "Ada", "one")
    assert (DONE.score, DONE.driver) == (87.3, "Ada")


@pytest.mark.parametrize("name, values", [("", VALUES), ("metre", {}), ("motors", {"state": "OK"})])
def test_another_programs_report_is_no_task(name, values):
    assert decode_task(name, "", values) is None


@pytest.mark.parametrize("text", ["nan", "inf", "-1", "100.1", "", "<b>", None])
def test_a_score_that_is_none_is_not_shown(text):
    task = decode_task("metre", "", {"state": "done", "score": text, "seconds": text and f"-{text}"})
    assert (task.score, task.seconds) == (None, None)


def test_texts_are_cut_off_and_harmless():
    task = decode_task("x" * 1000, "a\nb" + "c" * 1000,
                       {"state": "ready", "title": "\x1b[31m" * 100, "driver": "\r" * 99, "request": "\n" * 99})
    texts = task.name, task.title, task.text, task.driver, task.request
    assert list(map(len, texts)) == [60, 60, 200, 20, 60] and "".join(texts).isprintable()


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


def test_a_score_stays_until_the_next_task():
    done = tracker(DONE)
    assert done.current(False, 1000.0) == DONE
    done.update(READY, 1000.0)
    assert done.current(True, 2000.0) == READY, "a judge that waits may wait for long"


@pytest.mark.parametrize("commanded_by, name", [
    ("/jetbot_motion_control", "jetbot_motion_control"), ("/jetbot_cockpit", ""), ("nobody yet", ""), (None, "")])
def test_the_program_that_drives_a_robot_has_its_name(commanded_by, name):
    assert program(commanded_by, "/jetbot_cockpit") == name


@pytest.mark.parametrize("said, geometry", [
    (("0.1", "0.6"), (0.1, 0.6)), (("", ""), reports.CLOSED_LOOP), ((None, None), None), (("nan", "1"), None),
    (("0", "1"), None), (("x", "1"), None)])
def test_the_units_of_a_robots_commands(said, geometry):
    assert reports.geometry(*said) == geometry
