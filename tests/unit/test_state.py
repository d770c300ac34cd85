"""When the robot may move: a truth table with a clock turned by hand."""

import math

import pytest

from jetbot_control_node.control.state_machine import STOPPED, Sender, State
from jetbot_ros.state import EMERGENCY_STOP, NO_MASTER, sentence

GO = (0.5, 0.1)
PUPIL, IDLE = Sender("/pupil", number=1), Sender("/idle", number=2)
LATCHED = Sender("/pupil", latched=True, number=1)
NEW = State(timeout=1.0)
DRIVING, HOLDING = (State(timeout).command(*GO, PUPIL, now=0) for timeout in (1.0, 0))
STANDING_ORDER = NEW.command(*GO, LATCHED, now=0)
EMERGENCY = DRIVING.hold(EMERGENCY_STOP, True)
NO_MASTER_EITHER = EMERGENCY.hold(NO_MASTER, True)
NOT_FINITE = [(DRIVING.command(*command, PUPIL, now=0.1), STOPPED, "stopped: command was not finite", True)
              for bad in (math.nan, math.inf, -math.inf) for command in ((bad, 0.5), (0.5, bad), (bad, bad))]
TIMED_OUT = "stopped: no command for 1.0 s (repeat it: rostopic pub -r 10)"


@pytest.mark.parametrize("state, velocity, reason, alarm", [
    (DRIVING.disconnect(IDLE, others=True), GO, "driving", False),
    (NEW.check_timeout(now=100), STOPPED, "stopped: no command yet", False),
    (DRIVING.check_timeout(now=0.99), GO, "driving", False),
    (DRIVING.check_timeout(now=1), STOPPED, TIMED_OUT, True),
    (DRIVING.disconnect(PUPIL, others=False), STOPPED, "stopped: nobody is left to send commands", True),
    (HOLDING.disconnect(PUPIL, others=False), STOPPED, "stopped: nobody is left to send commands", True),
    (HOLDING.disconnect(PUPIL, others=True), STOPPED, "stopped: /pupil has ended", True),
    (HOLDING.confirm(PUPIL, 1e9).check_timeout(now=1e9), GO, "driving", False),
    (STANDING_ORDER.confirm(PUPIL, 8).check_timeout(now=8.9), GO, "driving", False),
    (STANDING_ORDER.check_timeout(now=1), STOPPED, "stopped: /pupil does not answer", True),
    (STANDING_ORDER.confirm(IDLE, 0.9).check_timeout(now=1), STOPPED, "stopped: /pupil does not answer",
     True),
    (STANDING_ORDER.disconnect(PUPIL, others=True), STOPPED, "stopped: /pupil has ended", True),
    (STANDING_ORDER.command(*GO, PUPIL, now=0.5).check_timeout(now=1.5), STOPPED, TIMED_OUT, True),
    (NEW.command(*GO, LATCHED._replace(old=True), now=0), STOPPED,
     "stopped: the command of /pupil is from before, repeat it", True),
    (DRIVING.command(0.1, 0, LATCHED._replace(old=True), now=0.1), GO, "driving", False),
    (DRIVING.command(0, 0, PUPIL, now=0.1).disconnect(PUPIL, others=False), STOPPED, "stopped: the command is zero",
     False),
    (NEW.command(0.1 + 0.2 - 0.3, 0, PUPIL, now=0), STOPPED, "stopped: the command is zero", False),
    (EMERGENCY, STOPPED, "stopped: emergency stop", True),
    (EMERGENCY.command(*GO, PUPIL, now=0.1).check_timeout(now=0.2), STOPPED, "stopped: emergency stop", True),
    (EMERGENCY.command(*GO, PUPIL, now=0.1).hold(EMERGENCY_STOP, False).check_timeout(now=0.2), STOPPED,
     "stopped: no command since the emergency stop was released", True),
    (NO_MASTER_EITHER, STOPPED, "stopped: emergency stop", True),
    (NO_MASTER_EITHER.hold(EMERGENCY_STOP, False).command(*GO, PUPIL, now=1), STOPPED,
     "stopped: no ROS master, so no emergency stop could arrive", True),
    (NO_MASTER_EITHER.hold(NO_MASTER, False).command(*GO, PUPIL, now=1), STOPPED, "stopped: emergency stop", True),
    *NOT_FINITE])
def test_what_may_be_driven_and_why(state, velocity, reason, alarm):
    assert (state.speeds, sentence(state.cause), state.alarm) == (velocity, reason, alarm)
