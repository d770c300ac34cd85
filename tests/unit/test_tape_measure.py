"""The questions with a tape measure, answered for a simulated robot with unequal wheels; and how far motions reach."""

import math

import pytest

from jetbot.kinematics import clamp, mix
from jetbot_tools.calibration import tape_measure
from jetbot_tools.calibration.corrections import ALPHAS
from jetbot_tools.calibration.motions import STEP, constant_speed, gentle, spin
from simulation.diff_drive import Motor, Pose

SEPARATION = 0.1125 * 1.08
KNOWN = {"left_motor_alpha": 0.97, "right_motor_alpha": 1.0, "min_duty": 0.007}


class Person:
    """Answers by the robot's true pose. stops: how many motions a key stops at first; skips: what is not wanted."""

    def __init__(self, stops=0, skips=(), min_duty=0.007):
        self.parameters = {**KNOWN, "min_duty": min_duty}
        self.stops, self.skips = stops, skips
        self.offers = []

    def drive(self, announcement, motion):
        """Drive as Wizard.drive_until_key does: note where the robot ends; return a step if a key stops it."""
        if self.stops:
            self.stops -= 1
            return motion[0]
        wheels, pose, self.rotation = [Motor(0.6, 0.1, 0.006), Motor(0.6 * 0.97, 0.1, 0.006)], Pose(), 0.0
        for left, right, seconds in [*motion, (0, 0, 2.0)]:
            duties = (self.duty(left, "left"), self.duty(right, "right"))
            rolled = [wheel.step(duty, seconds) for wheel, duty in zip(wheels, duties)]
            pose, self.rotation = pose.integrate_arc(*rolled, SEPARATION), self.rotation + rolled[1] - rolled[0]
        self.distance = math.hypot(pose.x, pose.y)
        return None

    def duty(self, speed, wheel):
        speed = clamp(speed * self.parameters[f"{wheel}_motor_alpha"], 1.0)
        min_duty = self.parameters.get("min_duty", 0.0)
        return speed and math.copysign(min_duty + (1 - min_duty) * abs(speed), speed)

    def answer(self, question):
        if "[y" in question:
            self.offers.append(question)
            return "" if any(skip in question for skip in self.skips) else "y"
        if "degrees" in question:
            return f"{math.degrees(self.rotation / SEPARATION):.0f}"
        return f"{100 * self.distance:.0f} cm"


@pytest.fixture
def measure(monkeypatch):
    """Lets a person answer all questions; returns that person."""
    def ask(**habits):
        person = Person(**habits)
        monkeypatch.setattr("builtins.input", person.answer)
        tape_measure.measure(person.drive, person.parameters)
        return person
    return ask


@pytest.mark.parametrize("min_duty", [0.007, 0.02])
@pytest.mark.parametrize("metres, radians", [(0.1, 0.0), (0.3, 0.0), (0.0, 0.5), (0.0, 1.5)])
def test_commands_are_metres_and_radians_when_slow_too(measure, min_duty, metres, radians):
    person = measure(min_duty=min_duty)
    separation, max_speed = person.parameters["wheel_separation"], person.parameters["max_speed"]
    person.drive("", constant_speed(*mix(metres, radians, separation, max_speed), 2.0))
    rolled = person.distance, person.rotation / SEPARATION
    assert rolled == pytest.approx((2 * metres, 2 * radians), rel=0.02, abs=0.01)


@pytest.mark.parametrize("skips, measured", [
    (("drives",), {"min_duty"}), (("turns",), {"max_speed"}), ((), {"max_speed", "wheel_separation"})])
def test_enter_alone_skips(measure, skips, measured):
    assert measure(skips=skips).parameters.keys() - set(ALPHAS) == measured


def test_a_motion_that_is_stopped_is_offered_again(measure, capsys):
    person = measure(stops=1)
    assert ["how far it drives" in offer for offer in person.offers][:3] == [True, True, False]
    assert "stopped, so there is nothing to measure" in capsys.readouterr().out
    assert 0.5 < person.parameters["max_speed"] < 0.7


def rolled(motion, min_duty):
    """How far each wheel rolls, in duties times seconds."""
    return tuple(sum(math.copysign(min_duty + (1 - min_duty) * abs(step[wheel]), step[wheel]) * step.seconds
                     for step in motion) for wheel in (0, 1))


@pytest.mark.parametrize("min_duty", [0.0, 0.1])
@pytest.mark.parametrize("seconds", [0.5, 0.7531, 2.0])
def test_a_gentle_motion_reaches_as_far_as_its_speed_does_in_that_time(seconds, min_duty):
    gentle_one, steady_one = gentle(-0.2, 0.2, seconds, min_duty), constant_speed(-0.2, 0.2, seconds)
    assert rolled(gentle_one, min_duty) == pytest.approx(rolled(steady_one, min_duty))
    assert rolled(steady_one, 0.0) == pytest.approx((-0.2 * seconds, 0.2 * seconds))
    assert max(step.seconds for step in gentle_one + steady_one) <= STEP


def test_a_gentle_motion_starts_and_ends_just_above_the_dead_band():
    speeds = [step.left for step in gentle(0.4, 0.4, 2.0, 0.0)]
    assert (speeds[0], max(speeds), speeds[-1]) == pytest.approx((0.08, 0.4, 0.08))
    assert max(abs(after - before) for before, after in zip(speeds, speeds[1:])) < 0.051


def test_a_turn_on_the_spot_reaches_its_angle():
    left, right = rolled(spin(math.pi, {"max_speed": 0.5, "wheel_separation": 0.12}), 0.0)
    assert 0.5 * (right - left) / 0.12 == pytest.approx(math.pi) and left == -right
