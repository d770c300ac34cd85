"""The score of a drive, and where it lost points."""

import math
from typing import NamedTuple, Optional, Sequence, Tuple

from .measures import TOLERANCE, describe, worst
from .penalties import Loss
from .recorder import DONE, Drive, Recorder, Sample
from .sentences import say
from .tasks import Task

TIME_SHARE = 0.2    # of the points depend on the time
NEGLIGIBLE = 0.5    # points that are not worth a sentence
NO_LOSS = say("no_loss")


class Result(NamedTuple):
    """A judged drive. score: 0 to 100; losses: the largest first."""

    task: Task
    drive: Drive
    score: float
    losses: Tuple[Loss, ...]

    @property
    def loss(self) -> Optional[Loss]:
        """What lost most points; None if nothing lost half a point."""
        return next((loss for loss in self.losses[:1] if loss.points >= NEGLIGIBLE), None)

    @property
    def largest_loss(self) -> str:
        """What lost most points, without a full stop; "" if nothing lost half a point."""
        return str(self.loss.sentence) if self.loss else ""

    @property
    def sentence(self) -> str:
        """The largest loss as a sentence."""
        said = say("largest_loss", loss=self.largest_loss, count=f"{self.loss.points:.1f}") if self.loss else NO_LOSS
        return str(said)


def judge(task: Task, samples: Sequence[Sample]) -> Result:
    """Return the result of the first drive in some samples. Raises NoDrive if there is none."""
    recorder = Recorder(task.time_limit, task.load_world(), task.is_over)
    for sample in samples:
        if recorder.feed(sample) == DONE:
            break
    return rate(task, recorder.finish())


def rate(task: Task, drive: Drive) -> Result:
    """Return the result of a drive."""
    errors = [measure(task.course, drive) for measure in task.measures]
    means = [sum(error.size for error in each) / len(each) for each in errors]
    time_ratio = min(1.0, task.ideal_seconds / drive.seconds)
    penalties = [loss for penalty in task.penalties for loss in penalty(drive, task.load_world())]
    points = 100 * _remaining(sum(means)) * (1 - TIME_SHARE + TIME_SHARE * time_ratio)
    score = max(0.0, points - sum(loss.points for loss in penalties))
    losses = [*map(_loss, means, errors), *penalties, _time_loss(task, drive, time_ratio)]
    return Result(task, drive, score, tuple(sorted(losses, key=lambda loss: -loss.points)))


def _remaining(error):
    """Return the fraction of the points that an error in cm or degrees leaves."""
    return math.exp(-error / TOLERANCE)


def _loss(mean, errors):
    error = worst(errors)
    return Loss(100 * (1 - _remaining(mean)), describe(error, mean, len(errors)), error.place)


def _time_loss(task, drive, time_ratio):
    sentence = say("slow", seconds=f"{drive.seconds:.1f}", ideal=f"{task.ideal_seconds:.1f}")
    return Loss(100 * TIME_SHARE * (1 - time_ratio), sentence, drive.end[:2])
