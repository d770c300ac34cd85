"""One robot at its task, from its start to its score."""

import math
from typing import Callable, Iterator, List, Optional

from jetbot.kinematics import Pose
from jetbot.sentence import Sentence
from jetbot.text import enumeration
from simulation.world_files import dump

from ..report.announcement import CANCELLED, READY, Announcement, in_english
from ..report.marks import Mark
from ..scoring.recorder import DONE, DRIVING, TWITCH, UNEXPLAINED, WAITING, NoDrive, Recorder, Sample, excursion
from ..scoring.score import rate
from ..scoring.sentences import say
from ..scoring.tasks import Task
from .judged_robot import JudgedRobot

INVITATION = "Drive when you are ready."
AT_START = 0.001         # m or rad: a pose so close to the start is there
MAX_GAP = 1.0            # s between two samples of a drive; what happened in a longer one is not known
ANNOUNCE_INTERVAL = 0.2  # s of the drive
REPORT_POLLS = 20        # polls of a robot that does not stop, from one report to the next;
MAX_POLLS = 100          # and until an attempt that was asked for is given up


class Interrupted(Exception):
    """sentence: why this drive gets no score."""

    def __init__(self, sentence: Sentence):
        super().__init__(str(sentence))
        self.sentence = sentence


class Attempt:
    """Judges the first drive of a robot that nothing interrupts; after an interruption, the robot starts again.

    show: prints a sentence for the person who drives; request: as of an Announcement, of an attempt that a page has
    asked for: an interruption ends that, without a score. mark: the result, once it is known. ready: whether the robot
    is at its start, and may drive; start: the last sample before it might.
    """

    def __init__(self, task: Task, robot: JudgedRobot, show: Callable[[str], None], request: Optional[str] = None):
        self._task, self.robot, self._show, self._once = task, robot, show, request is not None
        self._announcement = Announcement(robot.namespace, task, request or "")
        self._world, self._fed_at, self._announced_at = task.load_world(), 0.0, 0.0
        self._recorder = self._new_recorder()
        self._cancelled: List[Sentence] = []  # why the last drive did not count
        self._last_report, self._steps = "", self._run()
        self._name = ""  # of who drives, if it is known
        self.mark: Optional[Mark] = None
        self.start: Optional[Sample] = None
        self.ready = False

    @property
    def has_driven(self) -> bool:
        """Whether there is a drive, which may be over."""
        return self._recorder.state != WAITING

    def step(self) -> None:
        """Do what is due, without waiting: put the robot at its start, then measure; call it every POLL_INTERVAL."""
        self.robot.poll()
        if self._once and self.robot.interruptions:  # before the drive, too: who has asked for it drives no more
            self.cancel(self.robot.interruptions[0])
        else:
            next(self._steps, None)

    def finish(self) -> None:
        """Judge what was driven so far."""
        try:
            result = rate(self._task, self._recorder.finish())
        except NoDrive:
            problem = say("not_driven")
            self._announcement.publish(CANCELLED, problem)
            self._announcement.clear()
            self.mark = self._without_score(str(problem))
        else:
            self._announcement.done(result, self._name)
            self.mark = Mark(self._name, self._task.name, result, source=self.robot.source, robot=self.robot.name)

    def cancel(self, interruption: Sentence) -> None:
        """Give this drive no score, for this reason, or for what is in its way."""
        obstacle, advice = self.robot.obstacle, self.robot.advice
        self._cancelled = [interruption] if not obstacle else [say("not_counted")] if self.has_driven else []
        sentences = [*self._cancelled, *filter(None, [obstacle])]  # the obstacle is over before the invitation
        self.ready, self._recorder = False, self._new_recorder()
        self._announcement.publish(CANCELLED, *sentences)
        self._report(f"{in_english(sentences)} {advice}".rstrip())
        self.mark = self._without_score(in_english(sentences)) if self._once else None

    def close(self) -> None:
        """Show the task no longer to those who come now."""
        self._announcement.close()

    def _without_score(self, problem):
        return Mark(self._name, self._task.name, problem=problem, robot=self.robot.name)

    def _run(self) -> Iterator[None]:
        while not self.mark:
            try:
                yield from self._until_free()
                yield from self._prepare()
                yield from self._measure()
                self.finish()
            except Interrupted as interruption:
                self.cancel(interruption.sentence)

    def _new_recorder(self):
        return Recorder(self._task.time_limit, self._world, self._task.is_over)

    def _until_free(self):
        """Wait until the robot has stopped and nothing holds it; for a page, not for long."""
        polls = 0
        while self.robot.obstacle or not self.robot.has_stopped:
            polls += 1
            if self._once and polls > MAX_POLLS:
                raise Interrupted(say("never_stops"))
            if self.robot.obstacle:
                self._report(f"{self.robot.obstacle} {self.robot.advice}".rstrip())
            elif self.robot.latest and polls % REPORT_POLLS == 0:
                self._report_drive()
            yield

    def _report_drive(self):
        nodes = self.robot.commanders()
        end = f" End what drives it: {enumeration(nodes)}" if nodes else ""
        self._report(f"The robot drives. The judge waits until it has stopped.{end}")

    def _prepare(self):
        """Put the robot at its start, and the task's world around it."""
        yield from self.robot.put_at_start()
        yield from self._until_world()  # that of the start, too, is drawn: it must not pass for the next one
        self.robot.set_world(dump(self._world.placed(self.robot.latest.pose)))
        yield from self._until_world()
        self.start, self._recorder, self._name = self.robot.latest, self._new_recorder(), ""
        self._recorder.feed(self.start)
        self._announcement.draw(self.start.pose)
        self._invite()

    def _until_world(self):
        self._check_obstacle()
        while not self.robot.has_world:
            yield
            self._check_obstacle()

    def _invite(self):
        self.ready, self._announced_at = True, 0.0
        self._announcement.publish(READY, *self._cancelled, self._task.invitation)
        self._cancelled = []
        self._report(INVITATION)

    def _measure(self):
        """Record until the drive is done."""
        while self._recorder.state != DONE:
            for sample in self.robot.samples:
                self._feed(sample)
            self._check_driver()
            self._check_obstacle()
            self._announce_time()
            yield
        if not self.robot.has_stopped:
            self._report("The drive is over. The robot still drives: end its program.")

    def _feed(self, sample: Sample):
        was_driving, gap = self.has_driven, sample.time - self._fed_at
        self._fed_at = sample.time
        if was_driving and gap > MAX_GAP:
            raise Interrupted(say("not_measured", seconds=f"{gap:.1f}"))
        if self._recorder.feed(sample) == WAITING:
            self._check_place(was_driving)
        if self._recorder.unexplained > UNEXPLAINED:
            raise Interrupted(say("moved"))

    def _check_place(self, was_driving):
        """Let a drive begin only at the start."""
        frame = self._recorder.frame
        if not is_near(frame, self.start.pose):
            is_twitch = was_driving and excursion(frame, self.start.pose) <= TWITCH
            raise Interrupted(say("hardly_moved" if is_twitch else "put_elsewhere"))
        if was_driving and self._once:  # its program goes on
            raise Interrupted(say("put_back"))
        if was_driving:
            self._report("The robot was put back to its start.")
            self._invite()

    def _check_driver(self):
        if self._recorder.state == DRIVING:
            self._name = self.robot.driver or self._name
            for interruption in self.robot.interruptions:
                raise Interrupted(interruption)

    def _check_obstacle(self):
        if self.robot.obstacle:
            raise Interrupted(self.robot.obstacle)

    def _announce_time(self):
        seconds = self._recorder.seconds
        if self._recorder.state == DRIVING and seconds - self._announced_at >= ANNOUNCE_INTERVAL:
            self._announced_at = seconds
            self._announcement.driving(seconds)

    def _report(self, sentence):
        """Show a sentence, unless the last one says the same."""
        if not self._last_report.endswith(sentence):
            self._last_report = sentence
            self._show(sentence)


def is_near(pose: Pose, other: Pose) -> bool:
    """Return whether two poses on the map are the same, up to AT_START."""
    return (math.dist(pose[:2], other[:2]) <= AT_START
            and abs(math.remainder(pose.yaw - other.yaw, math.tau)) <= AT_START)
