"""When the robot may move: a truth table, and a small model beside which tens of thousands of events are tried."""

import math

import pytest
from hypothesis import settings, strategies
from hypothesis.stateful import Bundle, RuleBasedStateMachine, consumes, initialize, invariant, rule

from jetbot_control_node.control.state_machine import ANSWER_TIMEOUT, MANUAL_PRIORITY, STOPPED, Sender, State
from jetbot_ros.state import EMERGENCY_STOP, HOLDS, NO_MASTER, sentence

GO = (0.5, 0.1)
PUPIL = Sender("/pupil", number=1)
LATCHED = Sender("/pupil", latched=True, number=1)
NEW = State(timeout=1.0)
DRIVING, HOLDING = (State(timeout).command(*GO, PUPIL, now=0) for timeout in (1.0, 0))
STANDING_ORDER = NEW.command(*GO, LATCHED, now=0)
EMERGENCY = DRIVING.hold(EMERGENCY_STOP, True)
NO_MASTER_EITHER = EMERGENCY.hold(NO_MASTER, True)


@pytest.mark.parametrize("state, velocity, reason, alarm", [
    (DRIVING, GO, "driving", False),
    (NEW.check_timeout(now=100), STOPPED, "stopped: no command yet", False),
    (DRIVING.check_timeout(now=1), STOPPED, "stopped: no command for 1.0 s (repeat it: rostopic pub -r 10)", True),
    (HOLDING.disconnect(PUPIL, others=False), STOPPED, "stopped: nobody is left to send commands", True),
    (HOLDING.disconnect(PUPIL, others=True), STOPPED, "stopped: /pupil has ended", True),
    (STANDING_ORDER.check_timeout(now=1), STOPPED, "stopped: /pupil does not answer", True),
    (NEW.command(*GO, LATCHED._replace(old=True), now=0), STOPPED,
     "stopped: the command of /pupil is from before, repeat it", True),
    (NEW.command(0.1 + 0.2 - 0.3, 0, PUPIL, now=0), STOPPED, "stopped: the command is zero", False),
    (DRIVING.command(0, 0, PUPIL, now=0.1).disconnect(PUPIL, others=False), STOPPED, "stopped: the command is zero",
     False),
    (DRIVING.command(0.5, math.nan, PUPIL, now=0.1), STOPPED, "stopped: command was not finite", True),
    (EMERGENCY.command(*GO, PUPIL, now=0.1), STOPPED, "stopped: emergency stop", True),
    (EMERGENCY.hold(EMERGENCY_STOP, False), STOPPED, "stopped: no command since the emergency stop was released", True),
    (NO_MASTER_EITHER, STOPPED, "stopped: emergency stop", True),
    (NO_MASTER_EITHER.hold(EMERGENCY_STOP, False).command(*GO, PUPIL, now=1), STOPPED,
     "stopped: no ROS master, so no emergency stop could arrive", True)])
def test_what_may_be_driven_and_why(state, velocity, reason, alarm):
    assert (state.speeds, sentence(state.cause), state.alarm) == (velocity, reason, alarm)


SPEEDS = strategies.sampled_from([0.0, 0.1, -0.5, math.nan, math.inf])


class Decision(RuleBasedStateMachine):
    """Programs come, command, freeze, go, and come back; holds begin and end; time passes.

    The model knows only who is obeyed, how that program commands, and when it was last heard of. All times are sums of
    powers of two, so that no rounding decides what happens at a deadline.
    """

    connected = Bundle("connected")
    ended = Bundle("ended")

    def __init__(self):
        super().__init__()
        self.now, self.numbers = 0.0, 0
        self.obeyed, self.command_obeyed, self.heard_at = None, STOPPED, 0.0
        self.holds, self.manual_at = set(), -math.inf

    @property
    def limit(self):
        """How long the program that is obeyed may be silent, in s."""
        return ANSWER_TIMEOUT if self.obeyed.latched or not self.timeout else self.timeout

    def obey(self, sender, velocity):
        """A command that counts has arrived: the model follows it, unless it is zero or nonsense."""
        go = not self.holds and all(map(math.isfinite, velocity)) and any(velocity)
        self.obeyed, self.command_obeyed, self.heard_at = (sender if go else None), velocity, self.now

    @initialize(timeout=strategies.sampled_from([1.0, 0.0]))
    def start(self, timeout):
        self.timeout, self.state = timeout, State(timeout)

    @rule(target=connected, latched=strategies.booleans(), manual=strategies.booleans(),
          name=strategies.sampled_from(["/a", "/b"]))
    def connect(self, latched, manual, name):
        self.numbers += 1
        return Sender(name, latched, manual=manual, number=self.numbers)

    @rule(sender=connected, linear=SPEEDS, angular=SPEEDS)
    def command(self, sender, linear, angular):
        self.state = self.state.command(linear, angular, sender, self.now)
        if sender.manual or self.now - self.manual_at >= MANUAL_PRIORITY:
            self.manual_at = self.now if sender.manual else self.manual_at
            self.obey(sender, (linear, angular)) if not self.holds else None

    @rule(sender=connected, speed=SPEEDS)
    def deliver_what_is_from_before(self, sender, speed):
        driving = self.state.driving
        self.state = self.state.command(speed, 0.0, sender._replace(latched=True, old=True), self.now)
        assert self.state.driving == driving

    @rule(sender=ended, speed=SPEEDS)
    def deliver_what_an_ended_program_has_sent(self, sender, speed):
        before = self.state
        self.state = self.state.command(speed, 0.0, sender, self.now)
        assert self.state == before

    @rule(target=ended, sender=consumes(connected), others=strategies.booleans())
    def disconnect(self, sender, others):
        self.state = self.state.disconnect(sender, others)
        if self.obeyed and self.obeyed.number == sender.number:
            self.obeyed = None
        return sender

    @rule(sender=connected, delay=strategies.sampled_from([0.0, 0.25, 2.0]))
    def answer(self, sender, delay):
        self.state = self.state.confirm(sender, self.now - delay)
        if self.obeyed and self.obeyed.number == sender.number and (sender.latched or not self.timeout):
            self.heard_at = max(self.heard_at, self.now - delay)

    @rule(hold=strategies.sampled_from(HOLDS), engaged=strategies.booleans())
    def hold(self, hold, engaged):
        self.state = self.state.hold(hold, engaged)
        if engaged != (hold in self.holds):
            self.obeyed = None
        self.holds = self.holds | {hold} if engaged else self.holds - {hold}

    @rule(seconds=strategies.sampled_from([1 / 64, 3 / 8, 63 / 64, 1.0, MANUAL_PRIORITY]))
    def wait(self, seconds):
        self.now += seconds
        self.state = self.state.check_timeout(self.now)
        if self.obeyed and self.now - self.heard_at >= self.limit:
            self.obeyed = None

    @invariant()
    def drives_what_the_living_program_commands_and_nothing_else(self):
        assert self.state.speeds == (self.command_obeyed if self.obeyed else STOPPED)
        assert set(self.state.holds) == self.holds
        assert self.state.driving == (not self.state.cause)
        assert self.state.deadline == (self.heard_at + self.limit if self.obeyed else math.inf)


settings.register_profile("tens of thousands", max_examples=200, stateful_step_count=50, deadline=None,
                          derandomize=True, database=None)
settings.load_profile("tens of thousands")
TestDecision = Decision.TestCase
