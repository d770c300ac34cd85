"""What the judge says is data: each sentence is a row of a table, with the numbers as its arguments."""

from types import SimpleNamespace

import pytest

from driving_tasks.scoring.course import Course, Straight
from driving_tasks.scoring.measures import Error, describe, describe_last_turn, describe_turn, end
from driving_tasks.scoring.penalties import Loss, contacts
from driving_tasks.scoring.recorder import Drive, Sample
from driving_tasks.scoring.score import NO_LOSS, Result
from driving_tasks.scoring.sentences import not_counted, say
from driving_tasks.scoring.tasks import TASKS
from jetbot.kinematics import Pose

METRE = Course((Straight(1.0),))


def end_at(x, y, speed=0.0):
    """Return what is said of a drive of a metre that ends there."""
    (error,) = end(METRE, Drive((Sample(0.0, Pose(), 0.0), Sample(1.0, Pose(x, y, 0.0), speed)), 1.0, Pose()))
    return error.sentence


@pytest.mark.parametrize("x, y, way, text", [
    (1.05, 0.0, "past", "5 cm past the goal"), (0.9, 0.0, "short", "10 cm short of the goal"),
    (1.01, 0.03, "left", "3 cm left of the goal"), (1.0, -0.03, "right", "3 cm right of the goal"),
    (1.02, 0.03, "past_left", "2 cm past the goal and 3 cm left of it"),
    (1.03, -0.02, "past_right", "3 cm past the goal and 2 cm right of it"),
    (0.97, 0.03, "short_left", "3 cm short of the goal and 3 cm left of it"),
    (0.9, -0.15, "short_right", "10 cm short of the goal and 15 cm right of it")])
def test_where_a_drive_ends(x, y, way, text):
    stopped, driving = end_at(x, y), end_at(x, y, speed=0.3)
    assert (stopped.code, str(stopped)) == (f"stopped_{way}", f"stopped {text}")
    assert (driving.code, str(driving)) == (f"still_driving_{way}", f"was still driving {text}")
    assert not [value for value in stopped.arguments.values() if not value.replace(".", "").isdigit()]


@pytest.mark.parametrize("degrees, code, text", [
    (98, "turned_too_far", "turned 8 degrees too far"), (91, "turned_too_far", "turned 1 degree too far"),
    (88.5, "turned_too_little", "turned 1.5 degrees too little"), (-90, "turned_right", "turned to the right")])
def test_a_turn(degrees, code, text):
    assert (describe_last_turn(degrees, 90).code, describe_turn(degrees, 90, 3).code) == (code, f"{code}_corner")
    assert str(describe_last_turn(degrees, 90)).startswith(text)
    assert str(describe_turn(degrees, 90, 3)).startswith(f"{text} at corner 3")
    assert describe_last_turn(-degrees, -90).code == code.replace("right", "left")


@pytest.mark.parametrize("mean, text", [(1.0, "1 degree"), (1.5, "1.5 degrees"), (20.0, "20 degrees")])
def test_a_mean_has_its_own_plural(mean, text):
    error = Error(mean, describe_turn(91, 90, 1), (0, 0), has_mean=True)
    assert str(describe(error, mean, 8)) == f"turned 1 degree too far at corner 1, and {text} on average"


@pytest.mark.parametrize("times, text", [(1, ""), (2, " twice"), (3, " 3 times")])
def test_how_often_a_wall_was_touched(times, text):
    path = [Sample(float(time), Pose(clearance, 0.0, 0.0), 0.3) for time, clearance in enumerate((1.0, 0.0) * times)]
    (loss,) = contacts(Drive(tuple(path), 1.0, Pose()), SimpleNamespace(clearance=lambda pose: pose.x))
    assert str(loss.sentence) == f"touched a wall{text}"


@pytest.mark.parametrize("values, code, text", [
    ({"interruption": "taken"}, "not_counted_taken", "The drive does not count: a teacher took the robot over."),
    ({"interruption": "silent", "seconds": "0.3"}, "not_counted_silent",
     "The drive does not count: no command came from the driver's page for 0.3 s."),
    ({"interruption": "silent"}, "not_counted_because", "The drive does not count: so it was."),
    ({}, "not_counted_because", "The drive does not count: so it was.")],
    ids=["known", "with an argument", "without it", "of a cockpit from before"])
def test_what_a_cockpit_reports(values, code, text):
    sentence = not_counted({"name": "Ada", **values}, "so it was")
    assert (sentence.code, str(sentence)) == (code, text)


@pytest.mark.parametrize("losses, said, text", [
    ([Loss(39.3, say("touched_wall"), (0, 0))], "touched a wall", "Largest loss: touched a wall (39.3 points)."),
    ([Loss(0.4, say("touched_wall"), (0, 0))], "", str(NO_LOSS)), ([], "", "No loss of more than half a point.")])
def test_the_largest_loss_in_a_terminal(losses, said, text):
    result = Result(TASKS["metre"], None, 60.0, tuple(losses))
    assert (result.largest_loss, result.sentence) == (said, text)
