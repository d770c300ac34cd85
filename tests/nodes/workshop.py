"""The workshop's node, which commands ten motions and then ends."""
import rospy
from geometry_msgs.msg import Twist

rospy.init_node("driver")
print(rospy.get_param("~linear", 0.5), rospy.has_param("~linear"), rospy.get_name(), rospy.get_namespace())
publisher = rospy.Publisher("cmd_vel", Twist, queue_size=10)
while publisher.get_num_connections() == 0:
    rospy.sleep(0.01)
rate = rospy.Rate(10)
for count in range(10):
    twist = Twist()
    twist.linear.x = 0.5
    twist.angular.z = 0.1 * count
    publisher.publish(twist)
    rate.sleep()
print(twist)

#> 0.5 False /driver /
#> linear:
#>   x: 0.5
#>   y: 0.0
#>   z: 0.0
#> angular:
#>   x: 0.0
#>   y: 0.0
#>   z: 0.9
