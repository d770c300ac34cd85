"""A simulated robot: what the board commands turns its wheels, in steps of exactly 10 ms. No ROS."""

import math
from typing import Dict, List, Optional

from jetbot.fake.motors import Motors

from .diff_drive import PWM_FREQUENCY, STEP, DiffDriveModel, Pose
from .world import World

NANOSECONDS = 10_000_000        # of a step
MAX_STEPS = 100                 # at once: after a pause, the simulation catches up, and still obeys new commands
CLOCK_WAS_SET = 1_000_000_000   # ns between the stamps and the computer's clock: it is another time now
LASTING = 0.5                   # s that a wheel stalls until it is reported: a ramp passes through the dead band


class SimulatedRobot:
    """Registers on a fake bus, or a frame on a fake port -> wheels -> pose -> what sensors see.

    motors: what the board commands; model: at its start, in the world of its start.
    """

    def __init__(self, motors: Motors, model: DiffDriveModel):
        self._motors, self.model = motors, model
        self._start_pose, self._start_world = model.pose, model.world
        self._stall_report = StallReport()

    def place(self, pose: Optional[Pose] = None) -> None:
        """Put the robot at this pose, or back to its start, at rest."""
        self.model.place(pose or self._start_pose)

    def enter(self, world: Optional[World] = None) -> None:
        """Put this world around the robot, or that of its start."""
        self.model.enter(world or self._start_world)

    def step(self, steps: int) -> List[str]:
        """Advance by some steps as the board commands now; return a sentence for each stall and contact that begins."""
        frequency, speeds, was_touching = self._motors.pwm_frequency(), self._motors.speeds(), self.model.touching
        for _ in range(steps):
            self.model.step(speeds, STEP, frequency or PWM_FREQUENCY)
        stall = self._stall_report.update(self.model.stalled, frequency is None, steps * STEP)
        contact = "touched a wall" if self.model.touching and not was_touching else None
        return list(filter(None, [stall, contact]))

    @property
    def state(self) -> str:
        """The pose and the wheels' speeds, with two decimals."""
        pose, wheels = self.model.pose, (self.model.left.speed, self.model.right.speed)
        x, y, left, right = (f"{round(value, 2) + 0.0:.2f}" for value in (pose.x, pose.y, *wheels))  # and no -0.00
        return (f"at x {x} m, y {y} m, heading {round(math.degrees(pose.yaw))} deg; "
                f"left wheel {left} m/s, right wheel {right} m/s")


class StallReport:
    """Reports a stall once: until other wheels stall, or these turn, or get no power."""

    def __init__(self):
        self._lasts, self._reported = 0.0, ()

    def update(self, duties: Dict[str, float], fixed_pwm: bool, seconds: float) -> Optional[str]:
        """Return the sentence that is due now, or None.

        duties: as ``DiffDriveModel.stalled``, for these seconds; fixed_pwm: whether the board's PWM frequency cannot be
        set.
        """
        self._lasts = self._lasts + seconds if duties else 0.0
        wheels = tuple(duties) if self._lasts > LASTING else ()
        changed, self._reported = wheels != self._reported, wheels
        return describe_stall(duties, fixed_pwm) if wheels and changed else None


def describe_stall(duties: Dict[str, float], fixed_pwm: bool) -> str:
    """Return a sentence about the wheels that do not turn at these duties, with the largest of them, and advice."""
    wheels = "wheels get" if len(duties) > 1 else f"{''.join(duties)} wheel gets"
    percent = 100 * max(map(abs, duties.values()))
    advice = "raise min_duty" if fixed_pwm else "raise min_duty, or lower pwm_frequency"
    return f"the {wheels} {percent:.2g} % of full power, too little to turn: {advice}"


class StepClock:
    """Counts steps. now: a monotonic clock's time; stamp: the computer's at the same moment, both in ns.

    steps: how many were due since the start.
    """

    def __init__(self, now: int, stamp: int):
        self._started, self._first_stamp = now, stamp
        self.steps = 0

    @property
    def stamp(self) -> int:
        """The time of the last step, in ns: whole steps after the start."""
        return self._first_stamp + self.steps * NANOSECONDS

    def update(self, now: int, stamp: int) -> int:
        """Return how many steps are due, MAX_STEPS at most; the others are due in the next calls.

        The stamps follow the computer's clock only where that is set.
        """
        missing = (now - self._started) // NANOSECONDS - self.steps
        due = min(missing, MAX_STEPS)
        self.steps += due
        if due == missing and abs(stamp - self.stamp) > CLOCK_WAS_SET:
            self._first_stamp += stamp - self.stamp
        return due

    def remaining(self, now: int, steps: int) -> float:
        """Return the time in s until the next multiple of so many steps is due."""
        interval = steps * NANOSECONDS
        return (interval - (now - self._started) % interval) / 1e9
