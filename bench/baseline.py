#!/usr/bin/env python3
"""The workshop's script, with Adafruit's library called as the JetBot library calls it, on the fake bus."""

import rospy
from Adafruit_GPIO.I2C import Device
from Adafruit_MotorHAT import Adafruit_MotorHAT
from geometry_msgs.msg import Twist

from jetbot.fake.bus import FakeBus


class FakeI2C:
    """What Adafruit_MotorHAT takes as ``i2c``: makes Adafruit's own devices, on the fake bus."""

    def __init__(self, folder):
        self._folder = folder

    def get_i2c_device(self, address):
        return Device(address, 0, lambda _: FakeBus(self._folder))


class Motor:
    """A wheel, told at each change of its speed, on Adafruit's motor and on Waveshare's two outputs."""

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
    """A function of the speeds (left, right), in [-1, 1], that drives the robot on the fake bus in a folder."""
    hat = Adafruit_MotorHAT(i2c=FakeI2C(folder))
    motors = Motor(hat, 1, forward=1, backward=0), Motor(hat, 2, forward=2, backward=3)
    return lambda *speeds: [motor.drive(speed) for motor, speed in zip(motors, speeds)]


if __name__ == "__main__":
    rospy.init_node("jetbot_controller", anonymous=True)
    set_motors = open_driver(rospy.get_param("~folder"))
    rospy.Subscriber("cmd_vel", Twist, lambda twist: set_motors(twist.linear.x - twist.angular.z,
                                                                twist.linear.x + twist.angular.z))
    rospy.spin()
