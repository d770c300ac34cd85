"""Odometry and IMU of a board that measures them, as ROS messages."""

import math
import time

import rospy
from geometry_msgs.msg import Quaternion, TransformStamped, TwistWithCovariance
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu

from jetbot_ros.pose_tracker import Track

DRIFT = 0.05             # of the way driven and of the angle turned: wheel odometry on a floor, uncalibrated
RESOLUTION = 0.001       # m and rad
GYRO_ERROR = 0.09        # rad/s, and
ACCELERATION_ERROR = 0.8  # m/s^2: zero offsets of uncalibrated sensors (5 deg/s and 80 mg for an MPU-9250)
ANY_YAW = math.pi ** 2 / 3  # rad^2: the variance of a yaw of which nothing is known
UNKNOWN = 1e6            # variance of what is not measured


class OdometryPublisher:
    """Publishes ``odom``, ``imu/data_raw`` and, where asked for, tf odom -> base_footprint, for each Telemetry."""

    def __init__(self, publish_tf):
        self._odom = rospy.Publisher("odom", Odometry, queue_size=1)
        self._imu = rospy.Publisher("imu/data_raw", Imu, queue_size=1)
        prefix = rospy.get_namespace()[1:]  # red's frames are red/odom and so on
        self._odom_frame, self._base_frame, self._imu_frame = (
            prefix + name for name in ("odom", "base_footprint", "imu_link"))
        self._tf = make_broadcaster() if publish_tf else None
        self._track = Track()

    def __call__(self, telemetry):
        stamp = rospy.Time.now()
        self._track.add(telemetry.x, telemetry.y, telemetry.yaw, time.monotonic())
        self._publish_odometry(stamp, self._track)
        self._publish_imu(stamp, telemetry)

    def _publish_odometry(self, stamp, track):
        odom = Odometry()
        odom.header.stamp, odom.header.frame_id, odom.child_frame_id = stamp, self._odom_frame, self._base_frame
        odom.pose.pose.position.x, odom.pose.pose.position.y = track.x, track.y
        odom.pose.pose.orientation = Quaternion(z=math.sin(track.yaw / 2), w=math.cos(track.yaw / 2))
        yaw = min((DRIFT * track.turned) ** 2 + RESOLUTION ** 2, ANY_YAW)
        position = min(DRIFT ** 2 + yaw, 1) * track.driven ** 2 + RESOLUTION ** 2
        odom.pose.covariance = diagonal(position, yaw)
        odom.twist = twist(track.recent())
        self._odom.publish(odom)
        if self._tf:
            self._tf.sendTransform(as_transform(odom))

    def _publish_imu(self, stamp, telemetry):
        imu = Imu()
        imu.header.stamp, imu.header.frame_id = stamp, self._imu_frame
        imu.orientation_covariance[0] = -1  # the message's way to say that there is no orientation
        gyro, acceleration = imu.angular_velocity, imu.linear_acceleration
        gyro.x, gyro.y, gyro.z = telemetry.gyro
        acceleration.x, acceleration.y, acceleration.z = telemetry.acceleration
        imu.angular_velocity_covariance[0::4] = [GYRO_ERROR ** 2] * 3
        imu.linear_acceleration_covariance[0::4] = [ACCELERATION_ERROR ** 2] * 3
        self._imu.publish(imu)


def twist(recent):
    """The speeds of a ``Track.recent``, with their covariance."""
    if recent is None:
        return TwistWithCovariance(covariance=diagonal(UNKNOWN, UNKNOWN))
    seconds, ahead, turn = recent
    result = TwistWithCovariance(covariance=diagonal(*(
        (RESOLUTION / seconds) ** 2 + (DRIFT * change / seconds) ** 2 for change in (ahead, turn))))
    result.twist.linear.x, result.twist.angular.z = ahead / seconds, turn / seconds
    return result


def diagonal(position, yaw):
    """A covariance of x, y, z, roll, pitch, yaw, where only x, y and yaw are known."""
    covariance = [0.0] * 36
    covariance[0::7] = [position, position, UNKNOWN, UNKNOWN, UNKNOWN, yaw]
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
