"""A pupil's programs for the driving tasks, and the simulated robot that they drive.

A program is a generator: it sees the robot's ``pose`` and ``velocity`` (odometry), its ``eyes`` and the ``time``, and
yields what it would publish at 20 Hz: m/s, rad/s. ``start`` is where it should be at first.
"""

import math
from functools import lru_cache
from itertools import islice

from driving_tasks.scoring.recorder import Sample
from driving_tasks.scoring.tasks import TASKS
from jetbot.kinematics import clamp, mix, to_frame
from simulation.diff_drive import STEP, DiffDriveModel
from simulation.world import EMPTY

SEPARATION, FULL_SPEED = 0.1125, 0.6
LAG = 0.1       # s, of the motors: the robot rolls on for so long at the speed that it has
TICK = 0.05     # s between two commands


class Robot:
    """The simulated robot, in SI units."""

    def __init__(self, world=EMPTY):
        self._model = DiffDriveModel(world=world)
        self.time, self.samples = 0.0, []
        self.drive(0.0, 0.0)

    @property
    def pose(self):
        return self._model.pose

    @property
    def velocity(self):
        return self._model.velocity

    @property
    def eyes(self):
        return self._model.world.line_sensor(self.pose)

    def drive(self, linear, angular, seconds=TICK):
        duties = [clamp(duty, 1.0) for duty in mix(linear, angular, SEPARATION, FULL_SPEED)]
        for _ in range(round(seconds / STEP)):
            self.samples.append(Sample(self.time, self.pose, *self._model.velocity))
            self._model.step(duties, STEP)
            self.time = len(self.samples) * STEP


@lru_cache(None)
def run(program, world=EMPTY, time_limit=60.0):
    """Let a program drive, for ``time_limit`` seconds at most, then stop for 4 s; return the samples."""
    robot = Robot(world)
    for linear, angular in islice(program(robot, robot.pose), round(time_limit / TICK)):
        robot.drive(linear, angular)
    robot.drive(0.0, 0.0, 4.0)
    return robot.samples


def final_speed(remaining, now, top):
    """Return the speed for the next 0.05 s: the top speed, or what leaves just as much as the robot rolls on after it.

    remaining: m or rad; now: the speed by odometry. None: it rolls far enough.
    """
    rest = (remaining - LAG * now) / TICK
    return top if rest > 2 * top else rest / 2 if rest > top else rest if rest > top / 10 else None


def straight(length, speed=0.4, stop=True):
    """Drive ahead, backward if length is negative, on the line from ``start``."""
    def program(robot, start):
        direction = math.copysign(1, length)
        while True:
            along, left = to_frame(start, robot.pose[:2])
            remaining, now = abs(length) - direction * along, direction * robot.velocity[0]
            ahead = final_speed(remaining, now, speed) if stop else speed
            if ahead is None or remaining < LAG * now:
                return advanced(start, length, 0.0)
            lag = math.remainder(start.yaw - robot.pose.yaw, math.tau)
            yield direction * ahead, 3 * lag - 5 * direction * left
    return program


def turn(degrees):
    """Turn on the spot."""
    def program(robot, start):
        side, last, turned = math.copysign(1, degrees), start.yaw, 0.0
        while True:
            turned += side * math.remainder(robot.pose.yaw - last, math.tau)
            last = robot.pose.yaw
            rate = final_speed(abs(math.radians(degrees)) - turned, side * robot.velocity[1], 4.0)
            if rate is None:
                return advanced(start, 0.0, degrees)
            yield 0.0, side * rate
    return program


def wait(seconds):
    def program(robot, start):
        for _ in range(round(seconds / TICK)):
            yield 0.0, 0.0
        return start
    return program


def arc(radius, degrees, speed=0.4, stop=True):
    """Drive on a circle to the left (degrees > 0) or right from ``start``, steering back to it."""
    def program(robot, start):
        side, covered = math.copysign(1, degrees), 0.0
        last = -side * math.pi / 2  # the bearing of the robot as seen from the centre, in the frame of the start
        while True:
            x, y = to_frame(start, robot.pose[:2])
            bearing = math.atan2(y - side * radius, x)
            covered += side * math.remainder(bearing - last, math.tau)
            last = bearing
            remaining = radius * (math.radians(abs(degrees)) - covered)
            ahead = final_speed(remaining, robot.velocity[0], speed) if stop else speed
            if ahead is None or remaining < LAG * robot.velocity[0]:
                return advanced(start, radius * math.radians(abs(degrees)), degrees)
            outside = math.hypot(x, y - side * radius) - radius
            lag = math.remainder(start.yaw + bearing + side * math.pi / 2 - robot.pose.yaw, math.tau)
            yield ahead, side * (ahead / radius + 5 * outside) + 3 * lag
    return program


def advanced(start, length, degrees):
    """Return the pose at the end of an arc."""
    angle = math.radians(degrees)
    return start.integrate_arc(length - angle / 2, length + angle / 2, 1.0)


def one_after_the_other(*programs):
    """Drive one program after the other, each from where the one before says that it ends, or ended."""
    def program(robot, start):
        for each in programs:
            start = (yield from each(robot, start)) or robot.pose
        return start
    return program


def square(side=1.0, corner=90, corners=(1, 1, 1, 1, -1, -1, -1, -1), **at):
    """The square both ways; ``corner_3=98`` or ``side_2=0.9`` spoil one of them."""
    parts = []
    for number, sign in enumerate(corners, 1):
        parts += [straight(at.get(f"side_{number}", side)), wait(0.4),
                  turn(sign * at.get(f"corner_{number}", corner)), wait(0.4)]
    return one_after_the_other(*parts)


def round_trip(*parts):
    """Drive lengths in m, with turns in degrees between them."""
    return one_after_the_other(*(turn(part) if number % 2 else straight(part) for number, part in enumerate(parts)))


def ramp(length, rate, speed=0.3):
    """Speed up and brake at a rate in m/s^2."""
    def program(robot, start):
        begin = robot.time
        while True:
            remaining = length - robot.pose.x - LAG * robot.velocity[0]
            if remaining < 0.001:
                return start
            yield min(speed, 0.04 + rate * (robot.time - begin), max(0.04, math.sqrt(2 * rate * remaining))), 0.0
    return program


def follow(robot, start):
    """Steer by the eyes until they see no tape, then drive on to its end, and point along the room."""
    while min(robot.eyes) < 0.9:
        left, _, right = robot.eyes
        yield 0.22, 2.0 * (right - left)
    yield from straight(0.04)(robot, robot.pose)  # the eyes are 0.05 m ahead, and the robot is a little late
    if abs(robot.pose.yaw) > math.radians(2):
        yield from turn(math.degrees(-robot.pose.yaw))(robot, robot.pose)


def follow_for_ever(robot, start):
    """Steer by the eyes, and never stop: the workshop's loop."""
    while True:
        left, _, right = robot.eyes
        yield 0.12, 1.5 * (right - left)


BEND = math.degrees(2 * math.atan(0.5))
SOLUTIONS = {
    "metre": straight(1.0),
    "quarter": turn(90),
    "square": square(),
    "circle": arc(0.5, 360),
    "s_bend": one_after_the_other(arc(0.625, BEND, stop=False), arc(0.625, -BEND)),
    "smooth": ramp(1.0, 0.27),
    "park": one_after_the_other(arc(0.5, BEND, stop=False), arc(0.5, -BEND, stop=False), straight(0.3)),
    "follow": follow,
    "camera": follow,
    "roam": round_trip(0.75, 90, 0.75, 90, 1.0, 90, 0.75, -90, 0.5, -90, 0.75, 180, 1.62, 90, 1.5, 90, 0.62, 90, 0.4),
}


def solution(name):
    """Return the samples of the model solution of a task, at 100 Hz."""
    assert name in SOLUTIONS, f"write into SOLUTIONS of tests/unit/driving_pupil.py: a program that drives {name!r}"
    return run(SOLUTIONS[name], TASKS[name].load_world())
