"""Pictures that a person collects on the page: drives around in boxes.yaml, and presses Free or Blocked."""

import math
import random
from pathlib import Path
from typing import Callable, Iterator

from jetbot.camera.jpeg import bgr8_to_jpeg
from jetbot.kinematics import Pose
from jetbot.wait import wait_until
from jetbot_cockpit.session.collection import Collection
from simulation.picture import render
from simulation.world_files import load

ROOM = load("boxes.yaml")
MARGIN = 0.03    # m that a person keeps from walls
NEAREST = 0.005  # m to a wall
TIMEOUT = 30.0   # s


def free_way(pose):
    """Return how far the robot can drive straight ahead, in m, up to 0.5."""
    return next((way / 100 for way in range(51) if ROOM.clearance(pose.advance(way / 100, 0.0)) < MARGIN), 0.5)


RIGHT = {"free": lambda pose: free_way(pose) > 0.3, "blocked": lambda pose: free_way(pose) < 0.25}


def press(folder: Path, text: str) -> None:
    """Keep the pictures of who presses "Free 40 times", one button per line, where each is the right one."""
    kept = Collection(str(folder))
    for label, times, _ in map(str.split, text.lower().splitlines()):
        for _, pose in zip(range(int(times)), places(RIGHT[label])):
            jpeg = bgr8_to_jpeg(render(ROOM, pose))
            assert wait_until(lambda label=label, jpeg=jpeg: not kept.save("", label, jpeg), TIMEOUT)
        assert wait_until(lambda label=label, times=times: kept.state("")[label] == int(times), TIMEOUT), kept.state("")


def places(is_right: Callable[[Pose], bool]) -> Iterator[Pose]:
    """Yield such poses in the room, the same ones each time."""
    chosen = random.Random(1)
    while True:
        pose = Pose(chosen.uniform(-1, 1), chosen.uniform(-1, 1), chosen.uniform(-math.pi, math.pi))
        if ROOM.clearance(pose) > NEAREST and is_right(pose):
            yield pose
