"""Publishes what is driven now, and what the wheels get, for those who watch."""

import contextlib
import threading
import time
from typing import Sequence

import rospy
from std_msgs.msg import Float32MultiArray, MultiArrayDimension, MultiArrayLayout

from jetbot.boards import MotorDriver
from jetbot.kinematics import FULL_SPEED, WHEEL_SEPARATION, clamp, mix, unmix
from jetbot_ros.contract import WHEELS_LABEL

from ..control.state_machine import STOPPED
from ..control.supervisor import Step

CHANGING_INTERVAL = 0.1  # s between two messages, at least
STEADY_INTERVAL = 1.0    # s, while nothing changes
FLOAT32_MAX = 3.4e38     # the message carries no more


class WheelsPublisher:
    """Publishes ``~wheels`` from a thread of its own while somebody subscribes. Watches the Supervisor.

    geometry: of ``mix``, which has made the commands wheel speeds.
    """

    def __init__(self, driver: MotorDriver, geometry: Sequence[float]):
        self._closed_loop, self._geometry = driver.closed_loop, geometry
        self._driven = STOPPED, STOPPED
        self._changed = threading.Event()
        self._publisher = rospy.Publisher("~wheels", Float32MultiArray, queue_size=1)
        threading.Thread(target=self._run, daemon=True).start()

    def __call__(self, step: Step) -> None:
        driven = step.speeds, step.duties
        if driven != self._driven:
            self._driven = driven
            if self._publisher.get_num_connections():
                self._changed.set()

    def _run(self):
        with contextlib.suppress(rospy.ROSException):  # a shutdown closes the topic meanwhile
            while not rospy.is_shutdown():
                self._changed.wait(STEADY_INTERVAL)
                self._changed.clear()
                if self._publisher.get_num_connections():
                    self._publisher.publish(self._message())
                    time.sleep(CHANGING_INTERVAL)

    def _message(self):
        speeds, wheels = self._driven
        if self._closed_loop:  # m/s, of wheels that are 2 m apart, become fractions of full power
            wheels = (clamp(speed, 1.0) for speed in mix(*unmix(*wheels), WHEEL_SEPARATION, FULL_SPEED))
        layout = MultiArrayLayout([MultiArrayDimension(WHEELS_LABEL, 4, 4)], 0)
        command = (clamp(value, FLOAT32_MAX) for value in unmix(*speeds, *self._geometry))
        return Float32MultiArray(layout, [*command, *wheels])
