#!/usr/bin/env python3
"""The workshop's script, with Adafruit's library called as the JetBot library calls it, on the fake bus."""

from types import SimpleNamespace
from typing import Callable

import rospy
from Adafruit_GPIO.I2C import Device
from Adafruit_MotorHAT import Adafruit_MotorHAT
from geometry_msgs.msg import Twist

from jetbot.fake.bus import FakeBus


def open_driver(folder: str) -> Callable[[float, float], None]:
    """Return the function that drives the robot on the fake bus in a folder; see wire.open_driver."""
    fake_i2c = SimpleNamespace(get_i2c_device=lambda address: Device(address, 0, lambda _: FakeBus(folder)))
    hat = Adafruit_MotorHAT(i2c=fake_i2c)
    outputs = {hat.getMotor(1): (1, 0), hat.getMotor(2): (2, 3)}  # on Waveshare's board: forward, backward
    speeds = dict.fromkeys(outputs, 0.0)

    def set_motors(*wanted):
        for motor, speed in zip(outputs, wanted):
            if speed != speeds[motor]:
                speeds[motor] = speed
                level = max(-255, min(255, int(255 * speed)))
                motor.setSpeed(abs(level))
                motor.run(Adafruit_MotorHAT.BACKWARD if level >= 0 else Adafruit_MotorHAT.FORWARD)
                for output, duty in zip(outputs[motor], (max(level, 0), max(-level, 0))):
                    hat._pwm.setPWM(output, 0, 16 * duty)

    return set_motors


if __name__ == "__main__":
    rospy.init_node("jetbot_controller", anonymous=True)
    set_motors = open_driver(rospy.get_param("~folder"))
    rospy.Subscriber("cmd_vel", Twist, lambda twist: set_motors(twist.linear.x - twist.angular.z,
                                                                twist.linear.x + twist.angular.z))
    rospy.spin()
