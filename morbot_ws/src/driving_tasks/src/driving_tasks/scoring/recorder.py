"""What a robot did from its first motion to its stop, found among samples of where it was."""

import math
from typing import Callable, List, NamedTuple, Optional, Tuple

from jetbot.kinematics import Pose
from simulation.world import EMPTY, World

from .course import relative
from .sentences import SENTENCES

WAITING, DRIVING, DONE = "waiting", "driving", "done"

STILL, STILL_DEGREES = 0.001, 0.5  # m, degrees: within both of them of a pose, a robot is still there
TWITCH = 10                        # times as much; a motion that goes no farther is no drive
STOP_TIME = 3.0                    # s without motion, or without a sample, that end a drive
MARGIN = 0.3                       # s before the first motion and after the stop that belong to a drive's path
MIN_INTERVAL = 0.005               # s between two samples; what comes sooner is left out
MAX_SPEED, MAX_TURN = 2.0, 12.0    # m/s, rad/s; what seems faster is a robot that was put elsewhere
FARTHEST, LATEST = 1e4, 1e12       # m, s; what is beyond is no measurement
DEGREE = math.radians(1) / 0.01    # rad/m: one degree counts as one centimetre
UNEXPLAINED = 0.01                 # m; what exceeds it was done by no wheel: lost samples explain about half of it
MOVED = SENTENCES["moved"]
CONTACT = 0.001                    # m from a wall that stops the wheels within no time


class Sample(NamedTuple):
    """time: s, of the message's own stamp; pose: on the map; speed: m/s, forward; rotation: rad/s, to the left."""

    time: float
    pose: Pose
    speed: float
    rotation: float = 0.0


class NoDrive(ValueError):
    """One sentence: why there is nothing to judge."""


class Drive(NamedTuple):
    """A drive in the task's frame, where the robot starts at (0, 0, 0).

    path: a little more than the drive; its times count from the first motion, its headings are not normalized.
    seconds: from the first motion to the last stop. frame: the task's frame on the map. unexplained: as of the
    recorder.
    """

    path: Tuple[Sample, ...]
    seconds: float
    frame: Pose
    unexplained: float = 0.0

    @property
    def poses(self) -> Tuple[Pose, ...]:
        """Where the robot was, in the task's frame."""
        return tuple(sample.pose for sample in self.path)

    @property
    def end(self) -> Pose:
        """Where the robot stopped."""
        return self.path[-1].pose


class Recorder:
    """Finds the drive in a robot's samples, which are fed one by one.

    time_limit: s that a drive may take; world: around the robot, in the task's frame; is_over: whether a pose in that
    frame ends the drive; unexplained: m that the robot has moved, or degrees per cm, as its wheels do not explain.
    """

    def __init__(self, time_limit: float, world: World = EMPTY, is_over: Callable[[Pose], bool] = lambda pose: False):
        self._time_limit, self._world, self._is_over, self.unexplained = time_limit, world, is_over, 0.0
        self._samples: List[Sample] = []     # headings not normalized; before the first motion only the last MARGIN
        self._start: Optional[Sample] = None  # where the robot was before its first motion
        self._rest: Optional[Sample] = None   # since when, and where, the robot has been still
        self._departed = 0.0                 # the time of the first motion
        self._problem = "There is nothing to judge: no position of the robot was recorded."
        self.state = WAITING

    @property
    def frame(self) -> Optional[Pose]:
        """The task's frame on the map: the robot's pose before its first motion; None before the first sample."""
        return self._start and self._start.pose

    @property
    def seconds(self) -> float:
        """How long the robot has been driving, in s; after the drive, about how long it drove."""
        last = self._rest if self.state == DONE else self._samples and self._samples[-1]
        return last.time - self._departed if self.state != WAITING else 0.0

    def feed(self, sample: Sample) -> str:
        """Take the next sample; return the state: waiting, driving or done. What cannot be a measurement is ignored."""
        if self.state == DONE or not _is_measurement(sample):
            return self.state
        if not self._samples:
            self._wait(SENTENCES["not_driven"], sample)
        elif -1.0 < sample.time - self._samples[-1].time < MIN_INTERVAL:
            return self.state
        elif self._was_put_elsewhere(sample):
            self._wait("The robot was put elsewhere before it had stopped for 3 s, and did not drive from there."
                       if self.state == DRIVING else self._problem, sample)
        else:
            self._append(sample)
        return self.state

    def finish(self) -> Drive:
        """End the drive, and return it. Raises NoDrive if there was none."""
        if self.state == WAITING or self._is_twitch():
            raise NoDrive(self._problem)
        self.state = DONE
        return _cut(self._samples, self._start.pose, self._departed)._replace(unexplained=self.unexplained)

    def _wait(self, problem, sample):
        self.state, self._problem, self.unexplained = WAITING, problem, 0.0
        self._samples, self._start, self._rest = [sample], sample, sample

    def _was_put_elsewhere(self, sample):
        last = self._samples[-1]
        interval = max(sample.time - last.time, 2 * MIN_INTERVAL)  # stamps are not that exact
        distance = math.dist(sample.pose[:2], last.pose[:2])
        turn = math.remainder(sample.pose.yaw - last.pose.yaw, math.tau)
        clock_was_set_back = sample.time < last.time
        back_at_start = sample.pose == self._start.pose and excursion(last.pose, sample.pose) > TWITCH
        too_fast = distance > MAX_SPEED * interval or abs(turn) > MAX_TURN * interval
        return clock_was_set_back or back_at_start or too_fast

    def _append(self, sample):
        last = self._samples[-1]
        if self.state == DRIVING and sample.time - last.time >= STOP_TIME:  # nobody knows what the robot did meanwhile
            self._end(sample)
            return
        yaw = last.pose.yaw + math.remainder(sample.pose.yaw - last.pose.yaw, math.tau)
        sample = sample._replace(pose=sample.pose._replace(yaw=yaw))
        slip = _unexplained(last, sample)
        if slip and self._world.clearance(relative(sample.pose, self._start.pose)) > CONTACT:
            self.unexplained += slip
        self._samples.append(sample)
        if excursion(sample.pose, self._rest.pose) > 1:
            if self.state == WAITING:
                self.state, self._departed = DRIVING, _crossing(last, sample, self._start.pose)
            self._rest = sample
        if self.state == WAITING:
            while self._samples[0].time < sample.time - MARGIN:
                del self._samples[0]
        elif (sample.time - self._rest.time >= STOP_TIME or sample.time - self._departed > self._time_limit
              or self._is_over(relative(sample.pose, self._start.pose))):
            self._end(sample)

    def _end(self, sample):
        if self._is_twitch():
            self._wait(self._problem, sample)
        else:
            self.state = DONE

    def _is_twitch(self):
        return all(excursion(sample.pose, self._start.pose) <= TWITCH for sample in self._samples)


def _is_measurement(sample):
    time, pose, *velocity = sample
    return (all(map(math.isfinite, (time, *pose, *velocity)))
            and abs(time) < LATEST and max(map(abs, (*pose, *velocity))) < FARTHEST)


def _unexplained(before, after):
    """Return how far, in m, the robot went otherwise than its wheels turned, with a rotation's degrees as cm.

    The speed of a wheel only rises or only falls between two samples of a simulator, so each way is between those at
    the first speed and at the last.
    """
    half = (after.time - before.time) / 2
    length, rotation = half * (before.speed + after.speed), half * (before.rotation + after.rotation)
    margin, turn_margin = half * abs(after.speed - before.speed), half * abs(after.rotation - before.rotation)
    expected = before.pose.advance(length, rotation)
    distance = math.dist(after.pose[:2], expected[:2]) - margin - (abs(length) + margin) * turn_margin
    turned = abs(math.remainder(after.pose.yaw - expected.yaw, math.tau)) - turn_margin
    return max(0.0, distance, turned / DEGREE)


def excursion(pose, rest):
    """Return how far a pose is from another; up to 1, a robot is still there."""
    return max(math.hypot(pose.x - rest.x, pose.y - rest.y) / STILL,
               math.degrees(abs(pose.yaw - rest.yaw)) / STILL_DEGREES)


def _crossing(inside, outside, rest):
    """Return when, between two samples, the robot was just still at ``rest``."""
    near, far = excursion(inside.pose, rest), excursion(outside.pose, rest)
    return inside.time + (outside.time - inside.time) * (1 - near) / (far - near)


def _cut(samples, frame, departed):
    """Return the Drive that these samples hold, the last of which is where the robot stopped."""
    last = samples[-1]
    index = next(index for index in reversed(range(len(samples))) if excursion(samples[index].pose, last.pose) > 1)
    stopped = _crossing(samples[index + 1], samples[index], last.pose)
    kept = [sample for sample in samples if departed - MARGIN <= sample.time < min(last.time, stopped + MARGIN)]
    kept.append(last._replace(time=min(last.time, stopped + MARGIN)))
    path = tuple(sample._replace(time=sample.time - departed, pose=relative(sample.pose, frame)) for sample in kept)
    return Drive(path, stopped - departed, frame)
