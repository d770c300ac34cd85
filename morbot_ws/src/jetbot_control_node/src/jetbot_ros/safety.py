"""What decides whether the robot may move. No ROS and no clock: times are monotonic seconds, handed in."""

import math

STILL = (0.0, 0.0)


class Safety:
    """Turns commands and events into the ``velocity`` that may be driven now, with the ``reason`` for it.

    timeout: seconds without a command after which the robot stops; 0 holds the last command.
    velocity: (linear in m/s, angular in rad/s), always finite; alarm: whether something other than a command stops it.

    An emergency stop counts first, until it is released; then the newest command, until it is too old or nobody
    is left who could send another. Whatever stopped the robot, only a new command moves it again.
    """

    def __init__(self, timeout):
        self._timeout = timeout
        self._emergency = False
        self.commanded_at = None
        self._stop("no command yet", alarm=False)

    def command(self, linear, angular, now):
        """A command has arrived; one that is not finite stops the robot."""
        self.commanded_at = now
        if self._emergency:
            return
        if not (math.isfinite(linear) and math.isfinite(angular)):
            self._stop("command was not finite")
        elif (linear, angular) == STILL:
            self._stop("the command is zero", alarm=False)
        else:
            self.velocity, self.reason, self.alarm = (linear, angular), "driving", False

    def emergency_stop(self, engaged):
        """The emergency stop was pressed (True) or released (False)."""
        if engaged:
            self._stop("emergency stop")
        elif self._emergency:
            self._stop("no command since the emergency stop was released")
        self._emergency = engaged

    def watch(self, publishers, now):
        """Look at the time, and at how many publishers of commands are left. To be called often."""
        if self.velocity == STILL:
            return
        if publishers == 0:
            self._stop("nobody is left to send commands")
        elif self._timeout and now - self.commanded_at >= self._timeout:
            self._stop(f"no command for {self._timeout:.1f} s")

    def _stop(self, cause, alarm=True):
        self.velocity, self.reason, self.alarm = STILL, f"stopped: {cause}", alarm
