"""A drive follows from the wheels: what something else did to the robot is found, and no honest drive is suspected."""

import math
import random

import pytest
from driving_pupil import Robot, run, solution, straight, turn

from driving_tasks.report.marks import Mark
from driving_tasks.scoring.recorder import UNEXPLAINED, Recorder, Sample
from driving_tasks.scoring.score import judge
from driving_tasks.scoring.tasks import TASKS
from jetbot.kinematics import Pose
from simulation.diff_drive import JETBOT
from simulation.world import EMPTY, World

WALL = World(walls=(((0.5, -1.0), (0.5, 1.0)),))
CYCLE = 2  # steps of the simulator between two messages


def unexplained(samples, world=EMPTY):
    recorder = Recorder(60.0, world)
    for sample in samples:
        recorder.feed(sample)
    return recorder.unexplained


@pytest.mark.parametrize("name", TASKS)
def test_a_model_solution_is_explained_also_where_samples_are_lost(name):
    sent = solution(name)[::CYCLE]
    kept = random.Random(name)
    assert unexplained(sent) < UNEXPLAINED / 10
    assert unexplained(sample for sample in sent if kept.random() < 0.8) < UNEXPLAINED


@pytest.mark.parametrize("seed", range(5))
def test_a_simulator_that_pauses_and_a_wall_that_stops_wheels_which_turn_are_explained(seed):
    """After a pause it catches up with the command that it reads then: one message follows after many steps."""
    robot, chosen = Robot(WALL), random.Random(seed)
    messages = [robot.samples[0]]
    while robot.time < 20:
        robot.drive(*chosen.choice([(0.6, 0.0), (0.6, 1.0), (-0.3, 0.0), (0.1, 8.0)]), chosen.choice([0.02, 0.3]))
        messages.append(Sample(robot.time, robot.pose, *robot.velocity))
    assert any(message.speed == message.rotation == 0 for message in messages[1:]), "the wall has stopped it"
    assert unexplained(messages, WALL) < UNEXPLAINED


def put(robot, *pose):
    """``~set_pose``: as the simulator does it, at rest and as new."""
    robot._model.place(Pose(*pose))


def in_steps(count, seconds):
    def forge(robot):
        for number in range(1, count + 1):
            put(robot, number / count)
            robot.drive(0.0, 0.0, seconds)
    return forge


def while_the_wheels_turn(robot):
    for number in range(1, 101):
        put(robot, number / 100)
        robot.drive(0.3, 0.2)


def to_the_goal(robot):
    robot.drive(0.5, 0.0, 1.96)
    robot.drive(0.0, 0.0, 1.0)
    put(robot, 1.0)


def to_its_heading(robot):
    robot.drive(0.3, 0.0, 3.3)
    robot.drive(0.0, 0.0, 1.0)
    put(robot, *robot.pose[:2], math.radians(3))


@pytest.mark.parametrize("forge", [
    in_steps(100, 0.05), in_steps(1000, 0.02), while_the_wheels_turn, to_the_goal, to_its_heading])
def test_what_no_wheel_did_is_found(forge):
    robot = Robot()
    robot.drive(0.0, 0.0, 1.0)
    forge(robot)
    robot.drive(0.0, 0.0, 4.0)
    assert unexplained(robot.samples[::CYCLE]) > UNEXPLAINED


def test_poses_without_their_speeds_are_found():
    drive = [Sample(sample.time, sample.pose, 0.0) for sample in run(straight(1.0))]
    rotation = [sample._replace(rotation=0.0) for sample in run(turn(90))]
    assert min(map(unexplained, (drive, rotation))) > 0.5


def test_a_changed_simulator_is_named():
    changes = JETBOT._replace(max_speed=3.0, motor_lag=0.0).changes
    assert (JETBOT.changes, changes) == ("", "max_speed 3 for 0.6, motor_lag 0 for 0.1")
    mark = Mark("red", "metre", judge(TASKS["metre"], run(straight(1.0))), source=f"simulator with {changes}")
    assert mark.row[-1] == f"simulator with {changes}" and mark.sentences[-1] == f"Driven in a {mark.source}."
