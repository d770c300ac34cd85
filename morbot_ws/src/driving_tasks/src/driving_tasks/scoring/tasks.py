"""The tasks: a row each."""

import math
from functools import partial
from typing import NamedTuple, Tuple

from jetbot.kinematics import Pose
from jetbot.sentence import Sentence
from simulation.world import EMPTY, World
from simulation.world_files import load

from .course import Arc, Course, Step, Straight, Turn, relative, s_bend
from .measures import Measure, corners, end, line, sides, squares
from .penalties import Penalty, acceleration, contacts

SPEED = 0.3         # m/s, of the ideal drive
ACCELERATION = 0.3  # m/s^2, allowed in the task smooth
SQUARES = 30        # wanted in the task roam
OVERRUN = 0.1       # m past the end of the tape, and to its sides, where a drive that does not stop is over
TRACK = (Straight(0.4), Arc(0.4, 90), Arc(0.4, -90), Straight(0.3))  # of line.yaml


class Task(NamedTuple):
    """A task: its name, its title for people, what to drive, the steps of its course, what it measures.

    world: a file of the package simulation, "" for none; speed: m/s of the ideal drive, which reaches it with
    ``acceleration`` in m/s^2; seconds: of a drive without steps; by_camera: no program that drives it may read where
    the robot is, or its line sensor; overrun: m past the goal where the drive is over, infinite: nowhere.
    """

    name: str
    title: str
    instruction: str
    steps: Tuple[Step, ...]
    measures: Tuple[Measure, ...]
    penalties: Tuple[Penalty, ...] = ()
    world: str = ""
    speed: float = SPEED
    acceleration: float = math.inf
    seconds: float = 0.0
    by_camera: bool = False
    overrun: float = math.inf

    @property
    def invitation(self) -> Sentence:
        """What a page says when the robot is at its start."""
        return Sentence(f"drive_{self.name}", f"Drive when you are ready: {self.instruction}.")

    @property
    def course(self) -> Course:
        """The ideal line, in the task's frame."""
        return Course(self.steps)

    @property
    def ideal_seconds(self) -> float:
        """How long the ideal drive takes."""
        return self.seconds or self.course.seconds(self.speed) + self.speed / self.acceleration

    @property
    def time_limit(self) -> float:
        """How many seconds a drive may take; then it is judged as it is."""
        return self.seconds or max(60.0, 10 * self.ideal_seconds)

    def is_over(self, pose: Pose) -> bool:
        """Return whether a robot at this pose, in the task's frame, has passed the goal, and its drive is over."""
        if math.isinf(self.overrun):
            return False
        ahead, left, _ = relative(pose, self.course.goal)
        return ahead >= self.overrun >= abs(left)

    def load_world(self) -> World:
        """Return the walls and lines, in the task's frame. Raises InvalidValue."""
        return load(self.world) if self.world else EMPTY


TASKS = {task.name: task for task in (
    Task("metre", "One metre", "1 m straight ahead", (Straight(1.0),), (end,)),
    Task("quarter", "A quarter turn", "a quarter turn to the left on the spot", (Turn(90),), (end,)),
    Task("square", "A square, both ways round", "a square of 1 m to the left, then the same to the right",
         (Straight(1.0), Turn(90)) * 4 + (Straight(1.0), Turn(-90)) * 4, (sides, corners)),
    Task("circle", "A circle", "a circle of radius 0.5 m to the left, back to the start", (Arc(0.5, 360),),
         (end, line)),
    Task("s_bend", "An S-bend", "two equal arcs to the point (1, 0.5), heading as at the start", s_bend(1.0, 0.5),
         (end, line)),
    Task("smooth", "A smooth metre", "1 m straight ahead, gently", (Straight(1.0),), (end,),
         (partial(acceleration, limit=ACCELERATION),), acceleration=ACCELERATION),
    Task("park", "Park between two walls", "two equal arcs to (0.8, 0.4), then 0.3 m ahead into the gap",
         (*s_bend(0.8, 0.4), Straight(0.3)), (end,), (contacts,), "parking.yaml"),
    Task("follow", "Follow the line", "along the tape to its end", TRACK, (end, line), world="line.yaml", speed=0.2,
         overrun=OVERRUN),
    Task("camera", "Follow the line by camera", "along the tape to its end, by camera alone", TRACK, (end, line),
         world="line.yaml", speed=0.2, by_camera=True, overrun=OVERRUN),
    Task("roam", "Roam", "around the room for a minute, by camera alone, without touching a wall", (),
         (partial(squares, wanted=SQUARES),), (contacts,), "boxes.yaml", seconds=60.0, by_camera=True),
)}
