#!/usr/bin/env python3
import rospy
from geometry_msgs.msg import Twist


class Robot:
    def __init__(self, name, hz=10):
        rospy.init_node(name)
        self.publisher = rospy.Publisher("cmd_vel", Twist, queue_size=1)
        self.rate = rospy.Rate(hz)
        self.log = []
        while self.publisher.get_num_connections() == 0:
            self.rate.sleep()

    def move(self, x=0.0, z=0.0, ticks=5):
        twist = Twist()
        twist.linear.x, twist.angular.z = x, z
        for _ in range(ticks):
            self.publisher.publish(twist)
            self.rate.sleep()
        self.log.append((x, z))
        return self

    def stop(self):
        self.publisher.publish(Twist())
        self.rate.sleep()


class Dancer(Robot):
    def dance(self, *steps):
        for x, z in steps:
            self.move(x, z)

    def stop(self):
        super().stop()
        print(f"{len(self.log)} moves: {self.log}")


if __name__ == "__main__":
    dancer = Dancer("dancer")
    dancer.move(x=0.3).move(z=-0.2, ticks=3)
    dancer.dance((0.5, 0.1), (0.5, -0.1), (-0.4, 0))
    dancer.stop()
