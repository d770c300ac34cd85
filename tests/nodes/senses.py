"""What the robot reports: it stands at (1, 2), turned by 0.5 rad."""
import math

import rospy
from nav_msgs.msg import Odometry
from std_msgs.msg import Float32MultiArray

rospy.init_node("senses")
odometry = rospy.wait_for_message("odom", Odometry, timeout=5)
pose = odometry.pose.pose
print(pose.position)
print(round(2 * math.atan2(pose.orientation.z, pose.orientation.w), 6))
print(odometry.header.frame_id, odometry.child_frame_id)
print(odometry.twist.twist.linear.x, odometry.twist.twist.angular.z)
print(abs((rospy.Time.now() - odometry.header.stamp).to_sec()) < 1)
print(rospy.wait_for_message("line", Float32MultiArray).data)
print(rospy.wait_for_message("/jetbot_controller/wheels", Float32MultiArray, rospy.Duration(5)).data)

seen = {}


def on_message(message, name):
    seen[name] = seen.get(name, 0) + 1


subscribers = [rospy.Subscriber(name, kind, on_message, name) for name, kind in (
    ("odom", Odometry), ("/line", Float32MultiArray), ("jetbot_controller/wheels", Float32MultiArray))]
while len(seen) < 3 or min(seen.values()) < 5:
    rospy.sleep(0.1)
for each in subscribers:
    each.unregister()
rospy.sleep(0.1)
seen.clear()
rospy.sleep(0.3)
print(seen)

#> x: 1.0
#> y: 2.0
#> z: 0.0
#> 0.5
#> odom base_footprint
#> 0.0 0.0
#> True
#> (0.25, 0.5, 1.0)
#> (0.375, 0.125, 0.25, 0.5)
#> {}
