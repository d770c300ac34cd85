"""A drive from its commands alone: what a simulated robot of the shipped size does when it gets them."""

import math
from typing import Iterator, List, Sequence, Tuple

from jetbot.kinematics import Pose, clamp, mix
from jetbot_ros import parameters as controller
from simulation.collision import Collision
from simulation.diff_drive import DiffDriveModel
from simulation.parameters import PARAMETERS
from simulation.step_clock import STEP

from .drive import DONE, STOP_TIME, Recorder
from .samples import Sample
from .tasks import Task

Command = Tuple[float, float, float]  # time in s, linear.x, angular.z

STEPS_PER_SAMPLE = 2
CMD_VEL_TIMEOUT = controller.PARAMETERS["cmd_vel_timeout"].default  # s
WAIT = 60.0  # s that a robot may rest or twitch before its drive
BODY = ("wheel_separation", "wheel_diameter", "max_speed", "motor_lag", "dead_band")


def replay(commands: Sequence[Command], task: Task, wheel_separation: float = 2.0, max_speed: float = 1.0
           ) -> List[Sample]:
    """Return where a simulated robot is that gets these commands, among the task's walls, in the task's frame.

    It starts when the first command moves it; the times count from then on. Commands that are not finite, and those
    that are older than the one before, do not count. wheel_separation, max_speed: the controller's parameters.
    """
    duties = _duties(commands, wheel_separation, max_speed)
    end = min(duties[-1][0] + CMD_VEL_TIMEOUT + 2 * STOP_TIME, task.time_limit + WAIT) if duties else 0.0
    model = DiffDriveModel(*(PARAMETERS[name].default for name in BODY), pose=Pose())
    model.collision = Collision(task.load_world())
    recorder, samples = Recorder(task.time_limit), [Sample(0.0, model.pose, 0.0)]
    recorder.feed(samples[0])
    current = 0  # the index of the command that holds
    for number in range(round(end / STEP)):
        while current + 1 < len(duties) and duties[current + 1][0] <= number * STEP:
            current += 1
        time, wheels = duties[current]
        model.step(wheels if number * STEP - time < CMD_VEL_TIMEOUT else (0.0, 0.0), STEP)
        if (number + 1) % STEPS_PER_SAMPLE == 0:
            samples.append(Sample((number + 1) * STEP, model.pose, model.velocity[0]))
            if recorder.feed(samples[-1]) == DONE:
                break
    return samples


def _duties(commands, wheel_separation, max_speed) -> List[Tuple[float, Tuple[float, float]]]:
    """Return the times of the commands and what the wheels get, from the first command on that is not zero."""
    duties: List[Tuple[float, Tuple[float, float]]] = []
    start = None
    for time, linear, angular in _measured(commands):
        if start is None and (linear or angular):
            start = time
        if start is not None:
            left, right = mix(linear, angular, wheel_separation, max_speed)
            duties.append((time - start, (clamp(left, 1.0), clamp(right, 1.0))))
    return duties


def _measured(commands) -> Iterator[Command]:
    latest = -math.inf
    for command in commands:
        if all(map(math.isfinite, command)) and command[0] >= latest:
            latest = command[0]
            yield command
