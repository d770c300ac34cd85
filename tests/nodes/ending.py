"""A callback ends the node; its last functions may still publish, in their order."""
import rospy
from std_msgs.msg import Float32

rospy.init_node("ending")
publisher = rospy.Publisher("x", Float32, queue_size=10)
heard = []


def on_x(message):
    heard.append(message.data)
    if message.data == 2:
        rospy.signal_shutdown("enough")


def at_end():
    print("first", rospy.is_shutdown(), heard)
    publisher.publish(3)


rospy.Subscriber("x", Float32, on_x)
rospy.on_shutdown(at_end)
rospy.on_shutdown(lambda: print("second"))
while not publisher.get_num_connections():
    rospy.sleep(0.01)
publisher.publish(1)
publisher.publish(2)
rospy.spin()
print(rospy.is_shutdown())
publisher.publish(4)
rospy.sleep(0.01)
try:
    rospy.wait_for_message("x", Float32)
except rospy.ROSInterruptException as error:
    print(isinstance(error, rospy.ROSException), error)
try:
    rospy.on_shutdown(5)
except TypeError:
    print("TypeError")

#> first False [1.0, 2.0]
#> second
#> True
#> True rospy shutdown
#> TypeError
