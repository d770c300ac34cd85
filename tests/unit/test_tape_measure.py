"""The questions with a tape measure, answered for a simulated robot with unequal wheels."""

import math

import pytest

from jetbot.kinematics import clamp
from jetbot_tools import tape_measure
from simulation.diff_drive import Motor, Pose

SEPARATION = 0.1125 * 1.08
KNOWN = {"left_motor_alpha": 1.0, "right_motor_alpha": 1.0, "min_duty": 0.007}


class Person:
    """Answers by the robot's true pose. stops: how many motions a key stops at first; skips: what is not wanted."""

    def __init__(self, stops=0, skips=(), rounds=0):
        self.parameters = dict(KNOWN)
        self.stops, self.skips, self.rounds = stops, skips, rounds
        self.offers, self.ended = [], []

    def drive(self, announcement, motion):
        """Drive as Wizard.drive does: note where the robot ends; return a step if a key stops it."""
        if self.stops:
            self.stops -= 1
            return motion[0]
        wheels, pose, self.rotation = [Motor(0.6, 0.1, 0.006), Motor(0.6 * 0.97, 0.1, 0.006)], Pose(), 0.0
        for left, right, seconds in [*motion, (0, 0, 2.0)]:
            duties = (self.duty(left, "left"), self.duty(right, "right"))
            rolled = [wheel.step(duty, seconds) for wheel, duty in zip(wheels, duties)]
            pose, self.rotation = pose.integrate_arc(*rolled, SEPARATION), self.rotation + rolled[1] - rolled[0]
        self.x, self.y = 100 * pose.x, 100 * pose.y
        self.ended.append(math.hypot(self.x, self.y))
        return None

    def duty(self, speed, wheel):
        speed = clamp(speed * self.parameters[f"{wheel}_motor_alpha"], 1.0)
        return speed and math.copysign(0.007 + 0.993 * abs(speed), speed)

    def answer(self, question):
        if "[y" in question:
            self.offers.append(question)
            if "squares" in question:
                self.rounds -= 1
                return "y" if self.rounds >= 0 else ""
            return "" if any(skip in question for skip in self.skips) else "y"
        answers = {"Ahead or behind?": self.x, "Left or right?": self.y}
        if any(side in question for side in answers):
            words = question.partition("[")[2].strip("] ").split("/")
            return words[0] if next(answers[side] for side in answers if side in question) > 0 else words[1]
        if "degrees" in question:
            return f"{math.degrees(self.rotation / SEPARATION):.0f}"
        return f"{abs(self.y if 'left or right' in question else self.x):.0f} cm"


@pytest.fixture
def measure(monkeypatch):
    """Lets a person answer all questions; returns that person."""
    def ask(**habits):
        person = Person(**habits)
        monkeypatch.setattr("builtins.input", person.answer)
        tape_measure.measure(person.drive, person.parameters)
        return person
    return ask


@pytest.mark.parametrize("skips", [(), ("turns",)])
def test_two_rounds_of_squares_close_them(measure, skips):
    person = measure(skips=skips, rounds=3)
    assert max(person.ended[-6:-4]) > 50
    assert max(person.ended[-2:]) < 5


def test_without_squares_the_robot_drives_and_turns_as_far_as_it_should(measure):
    person = measure()
    person.drive("", tape_measure.gentle(0.4, 0.4, 2 / 0.4 / person.parameters["max_speed"], 0.0))
    assert person.ended[-1] == pytest.approx(200, rel=0.03)
    person.drive("", tape_measure.spin(math.pi, person.parameters))
    assert person.rotation / SEPARATION == pytest.approx(math.pi, rel=0.03)


@pytest.mark.parametrize("skips, measured", [
    (("drives",), []), (("turns",), ["max_speed"]), ((), ["max_speed", "wheel_separation"])])
def test_enter_alone_skips(measure, skips, measured):
    assert [name for name in measure(skips=skips).parameters if name not in KNOWN] == measured


@pytest.mark.parametrize("rounds", [0, 1])
def test_a_motion_that_is_stopped_is_offered_again(measure, rounds, capsys):
    person = measure(stops=1, rounds=rounds)
    assert ["how far it drives" in offer for offer in person.offers][:3] == [True, True, False]
    assert "stopped, so there is nothing to measure" in capsys.readouterr().out
    assert 0.5 < person.parameters["max_speed"] < 0.7


def test_a_square_that_is_stopped_changes_nothing(measure, capsys, monkeypatch):
    person = measure()
    before = dict(person.parameters)
    person.stops, person.rounds = 1, 1
    tape_measure.check_squares(person.drive, person.parameters)
    assert "The square was stopped. Nothing is changed." in capsys.readouterr().out
    assert person.parameters == before
