"""A drive from the commands alone: how a robot without a fault would have obeyed them."""

from typing import List, Sequence, Tuple

from .samples import Sample
from .tasks import Task

Command = Tuple[float, float, float]  # time in s, linear.x, angular.z


def replay(commands: Sequence[Command], task: Task, wheel_separation: float = 2.0, max_speed: float = 1.0
           ) -> List[Sample]:
    """Return where the simulated robot, with the task's walls, would have been; the options are the controller's."""
    raise NotImplementedError
