"""An attempt at a task, with a robot that is turned by hand: what interrupts it, and what is said of that, once."""

import pytest

from driving_tasks.report.announcement import in_english
from driving_tasks.scoring.recorder import MOVED, Sample
from driving_tasks.scoring.sentences import say
from driving_tasks.scoring.tasks import TASKS
from driving_tasks.sources import attempt
from driving_tasks.sources.attempt import MAX_POLLS, Attempt
from jetbot.kinematics import Pose

STOPPED = "The drive does not count: its program was stopped."
TAKEN, ENDED = say("not_counted_taken"), say("not_counted_cockpit_ended")
EMERGENCY = say("robot_emergency_stop")
RELEASE = "Release it: ./morbot stop --release"
INTERVAL = 0.1  # s between two samples


class Robot:
    """A judged robot, without ROS: where it is put, and what is in its way."""

    namespace, name, driver, source, set_back = "/red", "red", "Ada", "", 0.0

    def __init__(self):
        self.time, self.x, self.speed, self.yaw = 0.0, 0.0, 0.0, 0.0
        self.obstacle, self.advice = None, ""
        self.interruptions, self.samples, self.has_world, self.has_stopped = [], [], True, True
        self.latest = Sample(0.0, Pose(), 0.0)

    def poll(self):
        self.time += INTERVAL
        self.x += self.speed * INTERVAL
        self.latest = Sample(self.time, Pose(self.x, 0.0, self.yaw), self.speed)
        self.samples, self.has_stopped = [self.latest], not self.speed

    def put_at_start(self):
        self.x = 0.0
        yield

    def set_world(self, text):
        pass

    def commanders(self):
        return ["/pupil"]


class Announcement:
    """What is published."""

    def __init__(self, namespace, task, request=""):
        self.said, self.is_done = [], False

    def publish(self, state, *sentences, **values):
        self.said.append((state, in_english(sentences)))

    def done(self, result, driver):
        self.said.append(("done", result.sentence))

    def driving(self, seconds):
        self.said.append(("driving", ""))

    def draw(self, start):
        pass

    clear = close = lambda self: None


@pytest.fixture
def begin(monkeypatch):
    """A function that returns an attempt, and what it prints. request: None at a terminal."""
    monkeypatch.setattr(attempt, "Announcement", Announcement)

    def start(request="one", task="metre"):
        printed = []
        return Attempt(TASKS[task], Robot(), printed.append, request), printed
    return start


def step(judged, seconds=INTERVAL):
    for _ in range(round(seconds / INTERVAL)):
        judged.step()


@pytest.fixture
def driving(begin):
    """An attempt of a page, in its drive."""
    judged, _ = begin()
    drive(judged)
    return judged


def drive(judged):
    step(judged, 2)
    judged.robot.speed = 0.3
    step(judged, 1)
    assert judged.has_driven


def said(judged):
    return judged._announcement.said[-1]


def test_a_drive_has_a_score_3_s_after_its_stop(driving):
    step(driving, 1 / 0.3 - 1)
    driving.robot.speed = 0.0
    step(driving, 3.5)
    assert driving.mark.result.score > 50 and said(driving)[0] == "done"


@pytest.mark.parametrize("end, sentence", [
    (lambda robot: setattr(robot, "x", 0.0), "The robot was put back to its start, so the drive does not count."),
    (lambda robot: setattr(robot, "x", 5.0), "The robot was put elsewhere, so the drive does not count."),
    (lambda robot: setattr(robot, "x", robot.x + 0.05), MOVED),
    (lambda robot: setattr(robot, "time", robot.time + 1.5),
     "1.6 s of the drive were not measured, because the simulator or the judge paused."),
    (lambda robot: robot.interruptions.append(TAKEN),
     "The drive does not count: a teacher took the robot over."),
    (lambda robot: setattr(robot, "obstacle", EMERGENCY), f"The drive does not count. {EMERGENCY}")],
    ids=["back", "elsewhere", "moved", "paused", "taken", "stopped"])
def test_what_interrupts_the_drive_of_a_page_ends_it_in_one_sentence(driving, end, sentence):
    robot = driving.robot
    if sentence.startswith("The robot was put"):
        robot.speed = 0.0
    end(robot)
    step(driving)
    assert (said(driving), driving.mark.result) == (("cancelled", sentence), None)


@pytest.mark.parametrize("polls", [1, 2, 5])
def test_what_ends_the_page_ends_its_attempt_before_the_drive_too(begin, polls):
    judged, _ = begin()
    for _ in range(polls):
        judged.step()
    assert judged.mark is None
    judged.robot.interruptions.append(ENDED)
    judged.step()
    assert said(judged) == ("cancelled", "The drive does not count: the cockpit has ended.") and not judged.mark.result


@pytest.mark.parametrize("obstacle, sentence", [(None, STOPPED), (EMERGENCY, f"The drive does not count. {EMERGENCY}")])
def test_a_program_that_is_stopped_is_said_once_also_beside_an_emergency_stop(driving, obstacle, sentence):
    driving.robot.obstacle = obstacle
    driving.cancel(say("not_counted_program_stopped"))
    assert said(driving) == ("cancelled", sentence)


def test_a_twitch_is_called_one(begin):
    judged, _ = begin()
    step(judged, 2)
    judged.robot.speed = 0.05
    step(judged)
    judged.robot.speed = 0.0
    step(judged, 4)
    assert said(judged) == ("cancelled", "The robot hardly moved, so the drive does not count.")


@pytest.mark.parametrize("obstacle, sentence", [
    (None, "The robot does not stop. End the program that drives it."), (EMERGENCY, str(EMERGENCY))])
def test_a_robot_that_cannot_be_put_at_its_start_is_not_waited_for_long(begin, obstacle, sentence):
    judged, _ = begin()
    judged.robot.speed, judged.robot.obstacle = 0.0 if obstacle else 0.3, obstacle
    for _ in range(MAX_POLLS):
        judged.step()
    assert judged.mark is None
    judged.step()
    assert said(judged) == ("cancelled", sentence) and not judged.mark.result


def test_at_a_terminal_it_waits_and_says_what_to_do_which_no_page_reads(begin):
    judged, printed = begin(request=None)
    judged.robot.obstacle, judged.robot.advice = EMERGENCY, RELEASE
    for _ in range(2 * MAX_POLLS):
        judged.step()
    assert printed == [f"{EMERGENCY} {RELEASE}"] and judged.mark is None
    judged.robot.obstacle, judged.robot.advice = None, ""
    drive(judged)
    judged.robot.obstacle, judged.robot.advice = EMERGENCY, RELEASE
    step(judged)
    assert printed[-1] == f"The drive does not count. {EMERGENCY} {RELEASE}"
    assert said(judged) == ("cancelled", f"The drive does not count. {EMERGENCY}")
