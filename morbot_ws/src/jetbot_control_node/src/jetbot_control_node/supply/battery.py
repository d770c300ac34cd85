"""The supply as a ROS message."""

import contextlib
import math
import threading

import rospy
from sensor_msgs.msg import BatteryState

from jetbot.supply import Reading, Supply

from .supply_watch import SupplyWatch


def publish_supply(supply: Supply, watch: SupplyWatch) -> None:
    """From now on, read the supply and publish it as ``battery``, once in each second."""
    publisher = rospy.Publisher("battery", BatteryState, queue_size=1)

    def publish(reading):
        with contextlib.suppress(rospy.ROSException):  # the node is ending
            publisher.publish(battery_state(reading, supply.sensor))

    threading.Thread(target=watch.run, args=[publish, rospy.is_shutdown], daemon=True).start()


def battery_state(reading: Reading, sensor: str) -> BatteryState:
    """Return the reading as a message. sensor: what measures it."""
    message = BatteryState(voltage=reading.voltage, percentage=reading.percentage, location=sensor)
    message.header.stamp = rospy.Time.now()
    for unmeasured in ("temperature", "current", "charge", "capacity", "design_capacity"):
        setattr(message, unmeasured, math.nan)
    message.present = not math.isnan(reading.percentage)
    if message.present:
        message.power_supply_technology = BatteryState.POWER_SUPPLY_TECHNOLOGY_LION
    if reading.undervoltage is not None:
        message.power_supply_health = (BatteryState.POWER_SUPPLY_HEALTH_UNSPEC_FAILURE if reading.undervoltage
                                       else BatteryState.POWER_SUPPLY_HEALTH_GOOD)
    return message
