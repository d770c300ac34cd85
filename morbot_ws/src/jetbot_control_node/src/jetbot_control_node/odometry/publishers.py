"""Publishes a robot's odometry, measured or open-loop, and the IMU of a board that has one."""

import contextlib
import math
import threading
import time
from typing import Dict, List, Union

import rospy
from nav_msgs.msg import Odometry
from sensor_msgs.msg import Imu, JointState

from jetbot.boards import Telemetry
from jetbot.robot import Robot
from jetbot_ros import ros_messages

from ..control.supervisor import Step
from .dead_reckoning import DeadReckoning, OdometryState
from .pose_tracker import PoseTracker

GYRO_ERROR = 0.09         # rad/s, and
ACCELERATION_ERROR = 0.8  # m/s^2: zero offsets of uncalibrated sensors (5 deg/s and 80 mg for an MPU-9250)
RESOLUTION = 0.001        # m and rad
SPEED_RESOLUTION = 0.025  # m/s and rad/s: RESOLUTION in pose_tracker.WINDOW
MAX_YAW_ERROR = math.pi / 3 ** 0.5  # rad: of a yaw that may be any
UNKNOWN = 1e6             # variance of what is not measured
MOVING_INTERVAL = 1 / 30  # s between two messages of open-loop odometry while a wheel turns
STOPPED_INTERVAL = 1.0    # s, while none does


class OdometryPublisher:
    """Publishes ``odom`` and, if ``publish_tf``, tf odom -> base_footprint."""

    def __init__(self, publish_tf: bool):
        self._odom = rospy.Publisher("odom", Odometry, queue_size=1)
        self._tf = None
        if publish_tf:
            from tf2_ros import TransformBroadcaster  # here: tf2 takes memory, and most robots do not need it
            self._tf = TransformBroadcaster()

    def publish(self, stamp: rospy.Time, motion: Union[PoseTracker, OdometryState]) -> None:
        """Publish where the robot is at this time."""
        odom = odometry(stamp, motion)
        self._odom.publish(odom)
        if self._tf:
            self._tf.sendTransform(ros_messages.transform(stamp, odom.header.frame_id, odom.child_frame_id, motion))


class TelemetryPublisher:
    """Publishes odometry and ``imu/data_raw`` for each Telemetry of a board that measures its motion."""

    def __init__(self, publish_tf: bool):
        self._odometry = OdometryPublisher(publish_tf)
        self._imu = rospy.Publisher("imu/data_raw", Imu, queue_size=1)
        self._tracker = PoseTracker()

    def __call__(self, telemetry: Telemetry) -> None:
        stamp = rospy.Time.now()
        self._tracker.update((telemetry.x, telemetry.y, telemetry.yaw), time.monotonic())
        self._odometry.publish(stamp, self._tracker)
        self._imu.publish(imu(stamp, telemetry))


class OpenLoopOdometry:
    """Publishes ``odom``, ``joint_states`` and, if ``publish_tf``, tf from a thread of its own, and at the end.

    Watches the Supervisor. parameters: as ``parameters.resolve`` returns them.
    """

    def __init__(self, robot: Robot, parameters: Dict[str, object]):
        self._reckoning = DeadReckoning(robot.left_motor, robot.right_motor,
                                        parameters["max_speed"], parameters["wheel_separation"])
        self._odometry = OdometryPublisher(parameters["publish_tf"])
        self._joint_states = rospy.Publisher("joint_states", JointState, queue_size=1)
        self._started = threading.Event()
        rospy.on_shutdown(self._publish)
        threading.Thread(target=self._run, daemon=True).start()

    def __call__(self, step: Step) -> None:
        was_moving = self._reckoning.motion.moving
        self._reckoning(step)
        if self._reckoning.motion.moving and not was_moving:
            self._started.set()

    def _run(self):
        with contextlib.suppress(rospy.ROSException):  # a shutdown closes the topics meanwhile
            due = time.monotonic()
            while not rospy.is_shutdown():
                self._started.clear()
                motion = self._publish()
                due = max(due + MOVING_INTERVAL, time.monotonic())
                time.sleep(max(0.0, due - time.monotonic()))
                if not motion.moving:
                    self._started.wait(STOPPED_INTERVAL - MOVING_INTERVAL)
                    due = time.monotonic()

    def _publish(self) -> OdometryState:
        """Publish the motion at this moment, and return it."""
        stamp, motion = rospy.Time.now(), self._reckoning.motion.advance(time.monotonic())
        self._odometry.publish(stamp, motion)
        self._joint_states.publish(ros_messages.joint_states(stamp, *motion.joints))
        return motion


def odometry(stamp: rospy.Time, motion: Union[PoseTracker, OdometryState]) -> Odometry:
    """Return the pose and velocity, with covariances that grow with the path."""
    linear, angular = motion.velocity
    odom = ros_messages.odometry(stamp, motion, linear, angular)
    odom.pose.covariance = diagonal(RESOLUTION + motion.drift * motion.path_length,
                                    min(RESOLUTION + motion.drift * motion.total_rotation, MAX_YAW_ERROR))
    odom.twist.covariance = diagonal(SPEED_RESOLUTION + motion.drift * abs(linear),
                                     SPEED_RESOLUTION + motion.drift * abs(angular))
    return odom


def diagonal(position: float, yaw: float) -> List[float]:
    """Return a covariance matrix of x, y, z, roll, pitch, yaw. position: of x and y, the standard deviation."""
    covariance = [0.0] * 36
    covariance[0::7] = [position ** 2, position ** 2, UNKNOWN, UNKNOWN, UNKNOWN, yaw ** 2]
    return covariance


def imu(stamp: rospy.Time, telemetry: Telemetry) -> Imu:
    """Return the board's gyro and accelerometer."""
    message = Imu()
    message.header.stamp, message.header.frame_id = stamp, ros_messages.frame_name("imu_link")
    message.orientation_covariance[0] = -1  # as sensor_msgs/Imu marks an orientation that is not measured
    rates, acceleration = message.angular_velocity, message.linear_acceleration
    rates.x, rates.y, rates.z = telemetry.gyro
    acceleration.x, acceleration.y, acceleration.z = telemetry.acceleration
    message.angular_velocity_covariance[0::4] = [GYRO_ERROR ** 2] * 3
    message.linear_acceleration_covariance[0::4] = [ACCELERATION_ERROR ** 2] * 3
    return message
