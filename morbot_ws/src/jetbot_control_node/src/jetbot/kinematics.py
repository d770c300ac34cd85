"""From a Twist to two wheel speeds."""


def clamp(speed):
    """The speed, a finite number, brought into [-1, 1], where 1 is all that the motor can give."""
    return max(-1.0, min(1.0, speed))


def mix(linear, angular, wheel_separation=2.0, max_speed=1.0):
    """Wheel speeds (left, right), each in [-1, 1], that move the robot as asked.

    linear: forward speed in m/s; angular: turn to the left in rad/s. Both must be finite.
    wheel_separation: metres between the wheels; max_speed: m/s of a wheel at full power.
    The defaults make it the plain left = linear - angular, right = linear + angular.
    """
    turn = angular * (wheel_separation / 2)
    return clamp((linear - turn) / max_speed), clamp((linear + turn) / max_speed)
