"""Points that a drive loses beside its errors."""

from typing import Callable, List, NamedTuple

from jetbot.sentence import Sentence
from simulation.diff_drive import SEPARATED
from simulation.world import World

from .course import Point
from .recorder import Drive
from .sentences import say

TOUCHES = 0.001                   # m to the nearest wall, where a contact begins; at SEPARATED it is over
CONTACT = 20.0                    # points per contact
WINDOW = 0.2                      # s over which an acceleration is a mean
ALLOWANCE = 1.1                   # times the limit cost nothing yet
EXCESS, MAX_EXCESS = 20.0, 40.0   # points per 100 % above the limit, and at most


class Loss(NamedTuple):
    """points: how many are lost; sentence: what the robot did, without a full stop; place: (x, y), task's frame."""

    points: float
    sentence: Sentence
    place: Point


Penalty = Callable[[Drive, World], List[Loss]]


def contacts(drive: Drive, world: World) -> List[Loss]:
    """Return the loss for touching walls: 20 points each time."""
    places, touching = [], False
    for sample in drive.path:
        clearance = world.clearance(sample.pose)
        if not touching and clearance < TOUCHES:
            places.append(sample.pose[:2])
            touching = True
        elif clearance > SEPARATED:
            touching = False
    code = {1: "touched_wall", 2: "touched_wall_twice"}.get(len(places), "touched_wall_often")
    return [Loss(CONTACT * len(places), say(code, times=len(places)), places[0])] if places else []


def acceleration(drive: Drive, world: World, limit: float) -> List[Loss]:
    """Return the loss for speeding up or braking harder than ``limit`` in m/s^2."""
    rates = [((speed - abs(sample.speed)) / WINDOW, sample.pose[:2])
             for sample, speed in zip(drive.path, _speeds_after(drive.path))]
    largest = max((abs(rate) for rate, _ in rates), default=0.0)
    if largest <= ALLOWANCE * limit:
        return []
    rate, place = next(each for each in rates if abs(each[0]) >= 0.95 * largest)  # the first of about that size
    sentence = say("sped_up" if rate > 0 else "braked", acceleration=f"{largest:.2g}", limit=f"{limit:g}")
    return [Loss(min(MAX_EXCESS, EXCESS * (largest / limit - 1)), sentence, place)]


def _speeds_after(path):
    """Return the absolute speed, in m/s, WINDOW after each sample, as long as there are samples."""
    speeds, index = [], 0
    for sample in path:
        due = sample.time + WINDOW
        while path[index].time < due:
            index += 1
            if index == len(path):
                return speeds
        before, after = path[index - 1], path[index]
        share = (due - before.time) / (after.time - before.time)
        speeds.append(abs(before.speed) + share * (abs(after.speed) - abs(before.speed)))
    return speeds
