#!/usr/bin/env python3
"""The workshop's script, with Adafruit's library called as the JetBot library calls it, on the fake bus."""

from types import SimpleNamespace

import rospy
from Adafruit_GPIO.I2C import Device
from Adafruit_MotorHAT import Adafruit_MotorHAT
from geometry_msgs.msg import Twist

from jetbot.fake.bus import FakeBus


class Motor:
    """A motor of the JetBot library: on Adafruit's driver and on Waveshare's two outputs, written when it changes."""

    def __init__(self, hat, number, forward, backward):
        self._hat, self._motor, self._outputs = hat, hat.getMotor(number), (forward, backward)
        self._speed = 0.0

    def drive(self, speed):
        if speed == self._speed:
            return
        self._speed = speed
        level = max(-255, min(255, int(255 * speed)))
        self._motor.setSpeed(abs(level))
        self._motor.run(Adafruit_MotorHAT.BACKWARD if level >= 0 else Adafruit_MotorHAT.FORWARD)
        for output, duty in zip(self._outputs, (max(level, 0), max(-level, 0))):
            self._hat._pwm.setPWM(output, 0, 16 * duty)


def open_driver(folder):
    """Return the function that drives the robot on the fake bus in a folder; see wire.open_driver."""
    fake_i2c = SimpleNamespace(get_i2c_device=lambda address: Device(address, 0, lambda _: FakeBus(folder)))
    hat = Adafruit_MotorHAT(i2c=fake_i2c)
    motors = Motor(hat, 1, forward=1, backward=0), Motor(hat, 2, forward=2, backward=3)
    return lambda *speeds: [motor.drive(speed) for motor, speed in zip(motors, speeds)]


if __name__ == "__main__":
    rospy.init_node("jetbot_controller", anonymous=True)
    set_motors = open_driver(rospy.get_param("~folder"))
    rospy.Subscriber("cmd_vel", Twist, lambda twist: set_motors(twist.linear.x - twist.angular.z,
                                                                twist.linear.x + twist.angular.z))
    rospy.spin()
