#!/usr/bin/env python3
"""ROS node: the body of a robot whose motors are on the fake bus. Says where it is, in messages and in words."""

import itertools
import math
import sys
import threading
import time
from collections import deque

import rospy
from geometry_msgs.msg import Pose2D, PoseStamped, Quaternion, TransformStamped
from nav_msgs.msg import Odometry, Path
from sensor_msgs.msg import JointState
from std_srvs.srv import Empty, EmptyResponse
from tf2_ros import StaticTransformBroadcaster, TransformBroadcaster

from jetbot import InvalidValue
from jetbot.fake.bus import default_folder
from jetbot.fake.motors import wheel_speeds
from jetbot.i2c import fake_folder
from jetbot_ros.master import require_master
from jetbot_ros.parameters import checked
from simulation import ORIGIN, Body, Motor, Pose
from simulation.parameters import PARAMETERS

RATE = 50              # steps a second
STEPS_PER_PATH = 10    # between two messages of the path
STEPS_PER_REPORT = 50  # between two lines on the terminal
PATH_STEP = 0.05       # metres between two poses of the path
PATH_LENGTH = 1000     # poses; the oldest are forgotten


class Frames:
    """Names of the coordinate frames (REP 105), in a namespace with its name before them: red/odom.

    All robots share one map, and as this odometry never errs, every odom lies on it.
    """

    def __init__(self, namespace):
        prefix = namespace.strip("/")
        self.map = "map"
        self.odom, self.base_footprint = (f"{prefix}/{name}".strip("/") for name in ("odom", "base_footprint"))


class Simulator:
    """Moves the body by what the bus tells its motors. Callbacks and the main thread meet under a lock."""

    def __init__(self, body, read_duties):
        self.body = body
        self._read_duties = read_duties
        self._start = body.pose
        self._then = time.monotonic()
        self._lock = threading.Lock()
        self._frames = Frames(rospy.get_namespace())
        self._path = deque(maxlen=PATH_LENGTH)
        self._odom_topic = rospy.Publisher("odom", Odometry, queue_size=10)
        self._joints_topic = rospy.Publisher("joint_states", JointState, queue_size=10)
        self._path_topic = rospy.Publisher("path", Path, queue_size=1, latch=True)
        self._transforms = TransformBroadcaster()
        self._map_transform = StaticTransformBroadcaster()
        self._map_transform.sendTransform(transform(self._frames.map, self._frames.odom, rospy.Time.now(), ORIGIN))
        rospy.Subscriber("~set_pose", Pose2D, self._on_set_pose, queue_size=1)
        rospy.Service("~reset", Empty, self._on_reset)

    def _on_set_pose(self, pose):
        if all(map(math.isfinite, (pose.x, pose.y, pose.theta))):
            self._place(Pose(pose.x, pose.y, pose.theta))
        else:
            rospy.logwarn("A pose must be finite. The robot stays where it is.")

    def _on_reset(self, _):
        self._place(self._start)
        return EmptyResponse()

    def _place(self, pose):
        with self._lock:
            self.body.pose = pose
            self._path.clear()

    def step(self):
        """Move the body on to this moment, and publish where it is."""
        with self._lock:
            now, stamp = time.monotonic(), rospy.Time.now()
            self.body.move(self._read_duties(), now - self._then)
            self._then = now
            self._remember(stamp)
            self._odom_topic.publish(odometry(self._frames, stamp, self.body))
            self._joints_topic.publish(joint_state(stamp, self.body))
            self._transforms.sendTransform(
                transform(self._frames.odom, self._frames.base_footprint, stamp, self.body.pose))

    def _remember(self, stamp):
        pose = self.body.pose
        last = self._path[-1].pose.position if self._path else None
        if last is None or math.hypot(pose.x - last.x, pose.y - last.y) >= PATH_STEP:
            self._path.append(pose_stamped(self._frames.odom, stamp, pose))

    def publish_path(self):
        """Publish the path so far."""
        path = Path()
        path.header.frame_id = self._frames.odom
        with self._lock:
            path.poses = list(self._path)
        self._path_topic.publish(path)


def quaternion(yaw):
    return Quaternion(0, 0, math.sin(yaw / 2), math.cos(yaw / 2))


def pose_stamped(frame, stamp, pose):
    message = PoseStamped()
    message.header.frame_id, message.header.stamp = frame, stamp
    message.pose.position.x, message.pose.position.y = pose.x, pose.y
    message.pose.orientation = quaternion(pose.yaw)
    return message


def transform(parent, child, stamp, pose):
    """Where the child frame lies in its parent."""
    message = TransformStamped()
    message.header.frame_id, message.header.stamp, message.child_frame_id = parent, stamp, child
    message.transform.translation.x, message.transform.translation.y = pose.x, pose.y
    message.transform.rotation = quaternion(pose.yaw)
    return message


def odometry(frames, stamp, body):
    """Pose in the odom frame, velocity in the robot's own."""
    message = Odometry()
    message.header.frame_id, message.header.stamp, message.child_frame_id = frames.odom, stamp, frames.base_footprint
    message.pose.pose = pose_stamped(frames.odom, stamp, body.pose).pose
    message.twist.twist.linear.x, message.twist.twist.angular.z = body.velocity
    return message


def joint_state(stamp, body):
    """Angles and speeds of the wheels, by the names of the joints in jetbot.urdf."""
    message = JointState()
    message.header.stamp = stamp
    message.name = ["left_wheel_joint", "right_wheel_joint"]
    message.position, message.velocity = body.wheel_angles, body.wheel_rates
    return message


def in_words(body):
    """Pose and wheel speeds in a line."""
    pose, degrees = body.pose, round(math.degrees(body.pose.yaw))
    return (f"at x {decimal(pose.x)} m, y {decimal(pose.y)} m, heading {degrees} deg; "
            f"left wheel {decimal(body.left.speed)} m/s, right wheel {decimal(body.right.speed)} m/s")


def decimal(value):
    """With two decimals, and never as -0.00."""
    return f"{round(value, 2) + 0.0:.2f}"


def spin(simulator):
    """Step, publish and tell until the node ends."""
    name = rospy.get_namespace().strip("/")
    rate = rospy.Rate(RATE, reset=True)
    steps = itertools.count()
    told = None
    while not rospy.is_shutdown():
        step = next(steps)
        simulator.step()
        if step % STEPS_PER_PATH == 0:
            simulator.publish_path()
        if step % STEPS_PER_REPORT == 0 and in_words(simulator.body) != told:
            told = in_words(simulator.body)
            print(f"{name} {told}".strip(), flush=True)
        rate.sleep()


def main():
    require_master()
    rospy.init_node("jetbot_simulator")
    given = checked(rospy.get_param("~", {}), PARAMETERS)
    bus = given["i2c_bus"]
    folder = default_folder(rospy.get_namespace()) if bus == "fake" else fake_folder(bus)
    left, right = (Motor(given["max_speed"], given["motor_lag"], given["dead_band"]) for _ in range(2))
    body = Body(left, right, given["wheel_separation"], given["wheel_diameter"],
                Pose(given["x"], given["y"], given["yaw"]))
    spin(Simulator(body, lambda: wheel_speeds(folder, given["board"])))


if __name__ == "__main__":
    try:
        main()
    except InvalidValue as error:
        rospy.logfatal(error)
        sys.exit(1)
    except rospy.ROSException:
        if not rospy.is_shutdown():  # which closes the topics under the last step
            raise
    except KeyboardInterrupt:
        sys.exit(1)
