"""Odometry and IMU of a board that measures them, as ROS messages."""

import math
import time

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

ODOM, BASE, IMU = "odom", "base_footprint", "imu_link"
COUNTER_RANGE = 65.536   # m and rad: after so much, the board's int16 counters begin anew
DRIFT = 0.05             # of the way driven and of the angle turned: wheel odometry on a floor, uncalibrated
RESOLUTION = 0.001       # m and rad
GYRO_ERROR = 0.09        # rad/s, and
ACCELERATION_ERROR = 0.8  # m/s^2: zero offsets typical of uncalibrated sensors of these ranges
UNKNOWN = 1e6            # variance of what the wheels cannot measure


class OdometryPublisher:
    """Publishes ``odom``, ``imu/data_raw`` and, where asked for, tf odom -> base_footprint, for each Telemetry."""

    def __init__(self, publish_tf):
        self._odom = rospy.Publisher("odom", Odometry, queue_size=1)
        self._imu = rospy.Publisher("imu/data_raw", Imu, queue_size=1)
        self._tf = make_broadcaster() if publish_tf else None
        self._x = self._y = self._driven = self._turned = 0.0
        self._last = None

    def __call__(self, telemetry):
        stamp, now = rospy.Time.now(), time.monotonic()
        last, last_time = self._last or (telemetry, now)
        self._last = telemetry, now
        dx, dy, turn = (unwrapped(getattr(telemetry, name) - getattr(last, name)) for name in ("x", "y", "yaw"))
        self._x, self._y = (self._x + dx, self._y + dy) if now > last_time else (telemetry.x, telemetry.y)
        ahead = dx * math.cos(telemetry.yaw) + dy * math.sin(telemetry.yaw)
        self._driven += abs(ahead)
        self._turned += abs(turn)
        self._publish_odometry(stamp, telemetry.yaw, ahead, turn, (now - last_time) or math.inf)
        self._publish_imu(stamp, telemetry)

    def _publish_odometry(self, stamp, yaw, ahead, turn, seconds):
        odom = Odometry()
        odom.header.stamp, odom.header.frame_id, odom.child_frame_id = stamp, ODOM, BASE
        odom.pose.pose.position.x, odom.pose.pose.position.y = self._x, self._y
        odom.pose.pose.orientation = Quaternion(z=math.sin(yaw / 2), w=math.cos(yaw / 2))
        position, heading = ((DRIFT * way) ** 2 + RESOLUTION ** 2 for way in (self._driven, self._turned))
        odom.pose.covariance = diagonal(position + self._driven ** 2 * heading, heading)
        odom.twist.twist.linear.x, odom.twist.twist.angular.z = ahead / seconds, turn / seconds
        odom.twist.covariance = diagonal(*(RESOLUTION ** 2 / seconds ** 2 + (DRIFT * change / seconds) ** 2
                                           for change in (ahead, turn)))
        self._odom.publish(odom)
        if self._tf:
            self._tf.sendTransform(as_transform(odom))

    def _publish_imu(self, stamp, telemetry):
        imu = Imu()
        imu.header.stamp, imu.header.frame_id = stamp, IMU
        imu.orientation_covariance[0] = -1  # the message's way to say that there is no orientation
        gyro, acceleration = imu.angular_velocity, imu.linear_acceleration
        gyro.x, gyro.y, gyro.z = telemetry.gyro
        acceleration.x, acceleration.y, acceleration.z = telemetry.acceleration
        imu.angular_velocity_covariance[0::4] = [GYRO_ERROR ** 2] * 3
        imu.linear_acceleration_covariance[0::4] = [ACCELERATION_ERROR ** 2] * 3
        self._imu.publish(imu)


def unwrapped(change):
    """A difference of two counts, when the counter may have begun anew between them."""
    return (change + COUNTER_RANGE / 2) % COUNTER_RANGE - COUNTER_RANGE / 2


def diagonal(position, heading):
    """A covariance of x, y, z, roll, pitch, yaw, where only x, y and yaw are known."""
    covariance = [0.0] * 36
    covariance[0::7] = [position, position, UNKNOWN, UNKNOWN, UNKNOWN, heading]
    return covariance


def make_broadcaster():
    """A tf2 broadcaster; imported here, since tf2 takes memory that most robots can use otherwise."""
    import tf2_ros
    return tf2_ros.TransformBroadcaster()


def as_transform(odom):
    """The transform odom -> base_footprint that an Odometry holds."""
    transform = TransformStamped(header=odom.header, child_frame_id=odom.child_frame_id)
    transform.transform.translation.x = odom.pose.pose.position.x
    transform.transform.translation.y = odom.pose.pose.position.y
    transform.transform.rotation = odom.pose.pose.orientation
    return transform
