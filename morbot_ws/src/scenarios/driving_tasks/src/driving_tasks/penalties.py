"""Points that a drive loses beside its errors."""

from typing import Callable, List, NamedTuple

from simulation.world import World

from .course import Point
from .drive import Drive


class Loss(NamedTuple):
    """points: how many are lost; sentence: what the robot did, without a full stop; place: (x, y), task's frame."""

    points: float
    sentence: str
    place: Point


Penalty = Callable[[Drive, World], List[Loss]]
