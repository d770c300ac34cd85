"""A drive from its commands alone: what a simulated robot of the shipped size does when it gets them."""

import math
from typing import Dict, Iterator, List, Sequence, Tuple

from jetbot.kinematics import clamp, mix
from jetbot_control_node import parameters as controller
from jetbot_control_node.control.ramp import Ramp
from simulation.diff_drive import PWM_FREQUENCY, STEP, DiffDriveModel

from ..scoring.recorder import DONE, STOP_TIME, Recorder, Sample
from ..scoring.tasks import Task

Command = Tuple[float, float, float]  # time in s, linear.x, angular.z

STEPS_PER_SAMPLE = 2
CMD_VEL_TIMEOUT = controller.PARAMETERS["cmd_vel_timeout"].default  # s
WAIT = 60.0  # s that a robot may rest or twitch before its drive
STOPPED = (0.0, 0.0)  # m/s, rad/s


def read_config(config: str) -> Dict[str, float]:
    """Return what a file of the controller's parameters says of commands, or the defaults. Raises InvalidValue."""
    values = controller.checked(controller.load(controller.find_file(config, ())) if config else {})
    return {name: values[name] for name in ("wheel_separation", "max_speed", "acceleration_limit", "pwm_frequency")}


def replay(commands: Sequence[Command], task: Task, wheel_separation: float = 2.0, max_speed: float = 1.0,
           acceleration_limit: float = 0.0, pwm_frequency: float = PWM_FREQUENCY) -> List[Sample]:
    """Return where a simulated robot is that gets these commands, among the task's walls, in the task's frame.

    It starts when the first command moves it; the times count from then on. Commands that are not finite, and those
    that are older than the one before, do not count. The rest are the controller's parameters of these names.
    """
    model = DiffDriveModel(world=task.load_world())
    ramp = Ramp(acceleration_limit, wheel_separation, max_speed)
    recorder, samples = Recorder(task.time_limit), [Sample(0.0, model.pose, *model.velocity)]
    recorder.feed(samples[0])
    for number, velocity in enumerate(_in_force(_driven(commands), task.time_limit + WAIT), 1):
        wheels = mix(*ramp.limit(velocity, number * STEP), wheel_separation, max_speed)
        model.step(tuple(clamp(speed, 1.0) for speed in wheels), STEP, pwm_frequency)
        if number % STEPS_PER_SAMPLE == 0:
            samples.append(Sample(number * STEP, model.pose, *model.velocity))
            if recorder.feed(samples[-1]) == DONE:
                break
    return samples


def _driven(commands) -> List[Command]:
    """Return the commands from the first one on that is not zero; their times count from then on."""
    measured = list(_measured(commands))
    first = next((index for index, (_, *velocity) in enumerate(measured) if any(velocity)), len(measured))
    return [(time - measured[first][0], linear, angular) for time, linear, angular in measured[first:]]


def _in_force(commands, seconds) -> Iterator[Tuple[float, float]]:
    """Yield the velocity to drive at each step, until the robot has stopped for long or these seconds are over."""
    end = min(commands[-1][0] + CMD_VEL_TIMEOUT + 2 * STOP_TIME, seconds) if commands else 0.0
    index = 0
    for now in (number * STEP for number in range(round(end / STEP))):
        while index + 1 < len(commands) and commands[index + 1][0] <= now:
            index += 1
        time, *velocity = commands[index]
        yield velocity if now - time < CMD_VEL_TIMEOUT else STOPPED


def _measured(commands) -> Iterator[Command]:
    latest = -math.inf
    for command in commands:
        if all(map(math.isfinite, command)) and command[0] >= latest:
            latest = command[0]
            yield command
