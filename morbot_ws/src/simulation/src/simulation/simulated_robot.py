"""A simulated robot: what the board commands turns its wheels, in steps of exactly 10 ms. No ROS."""

import math
from typing import Dict, List, Optional

from jetbot.fake.motors import Motors

from .diff_drive import PWM_FREQUENCY, STEP, DiffDriveModel, Pose
from .world import World

NANOSECONDS = 10_000_000  # of a step
MAX_STEPS = 1000          # at once; after a longer pause, or where the clock is set, the simulation has paused too
STALL_TIME = 0.5          # s that a wheel stalls until it is reported: a ramp passes through the dead band


class SimulatedRobot:
    """Registers on a fake bus, or a frame on a fake port -> wheels -> pose -> what sensors see.

    motors: what the board commands; model: at its start, in the world of its start.
    """

    def __init__(self, motors: Motors, model: DiffDriveModel):
        self._motors, self.model = motors, model
        self._start_pose, self._start_world = model.pose, model.world
        self._stalled_for = 0.0  # s

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
        sentences = ["touched a wall"] if self.model.touching and not was_touching else []
        stalled_before, duties = self._stalled_for, self.model.stalled
        self._stalled_for = stalled_before + steps * STEP if duties else 0.0
        if stalled_before <= STALL_TIME < self._stalled_for:
            sentences.append(describe_stall(duties, frequency is None))
        return sentences

    @property
    def state(self) -> str:
        """The pose and the wheels' speeds, with two decimals."""
        pose, wheels = self.model.pose, (self.model.left.speed, self.model.right.speed)
        x, y, left, right = (f"{round(value, 2) + 0.0:.2f}" for value in (pose.x, pose.y, *wheels))  # and no -0.00
        return (f"at x {x} m, y {y} m, heading {round(math.degrees(pose.yaw))} deg; "
                f"left wheel {left} m/s, right wheel {right} m/s")


def describe_stall(duties: Dict[str, float], fixed_pwm: bool) -> str:
    """Return a sentence about the wheels that do not turn at these duties, with the largest of them, and advice.

    fixed_pwm: whether the board's PWM frequency cannot be set.
    """
    wheels = "wheels get" if len(duties) > 1 else f"{''.join(duties)} wheel gets"
    percent = 100 * max(map(abs, duties.values()))
    advice = "raise min_duty" if fixed_pwm else "raise min_duty, or lower pwm_frequency"
    return f"the {wheels} {percent:.2g} % of full power, too little to turn: {advice}"


class StepClock:
    """Counts the steps that are due. stamp: the time of the last one, in ns: whole steps after the start."""

    def __init__(self, now: int):
        self.stamp = now

    def update(self, now: int) -> int:
        """Return how many steps are due."""
        due = (now - self.stamp) // NANOSECONDS
        self.stamp += due * NANOSECONDS
        return due if 0 <= due <= MAX_STEPS else 0

    def remaining(self, now: int, steps: int) -> float:
        """Return the time in s until so many steps after the last one are due."""
        interval = steps * NANOSECONDS
        return (interval - (now - self.stamp) % interval) / 1e9
