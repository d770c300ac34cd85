"""What publish() takes, and what it refuses."""
import rospy
from geometry_msgs.msg import Pose2D, PoseStamped, Twist, Vector3
from std_msgs.msg import Bool, Empty, Float32, Float64, Int32, String, UInt8


def attempt(function, *args, **kwds):
    try:
        function(*args, **kwds)
        return True
    except (AttributeError, TypeError, ValueError, rospy.ROSException) as error:
        print(type(error).__name__, " ".join(str(error).split()))
        return False


received = []
attempt(rospy.Publisher, "", Twist, queue_size=1)
attempt(rospy.Publisher, "a", None, queue_size=1)
attempt(rospy.Publisher, "a", Twist(), queue_size=1)
attempt(rospy.Publisher, "~a", Twist, queue_size=1)
attempt(rospy.Publisher("early", Twist, queue_size=1).publish, Twist())
attempt(rospy.init_node, "")
attempt(rospy.init_node, "a/b")
attempt(rospy.Rate, 10)
rospy.init_node("publishing")
publisher, topics = {}, (Twist, Float32, Float64, Int32, Bool, String, Empty, Vector3, UInt8, Pose2D, PoseStamped)
for topic in topics:
    rospy.Subscriber(topic.__name__.lower(), topic, received.append)
    publisher[topic] = rospy.Publisher(topic.__name__.lower(), topic, queue_size=10)
while not all(each.get_num_connections() for each in publisher.values()):
    rospy.sleep(0.01)


def publish(topic, *args, **kwds):
    del received[:]
    if attempt(publisher[topic].publish, *args, **kwds):
        while not received:
            rospy.sleep(0.01)
        print(" ".join(str(received).split()))
    elif received:
        print("refused, and received", received)


publish(Twist, Twist())
publish(Twist, Vector3(1, 0, 0), Vector3())
publish(Twist, linear=Vector3(1, 0, 0))
publish(Twist)
publish(Twist, Vector3())
publish(Twist, 0.5)
publish(Twist, Float32(1))
publish(Twist, Twist(), linear=Vector3())
publish(Twist, Twist(Vector3("fast", 0, 0), Vector3()))
publish(Twist, Twist(linear=5))
publish(Float32, 0.1)
publish(Float32, 1)
publish(Float32, Float32(True))
publish(Float32, data=0.25)
publish(Float32, date=0.25)
publish(Float32, "much")
publish(Float64, 0.1)
publish(Int32, 3)
publish(Int32, 1.5)
publish(Int32, 2 ** 31)
publish(UInt8, -1)
publish(Bool, True)
publish(String, "ü")
publish(String, 5)
publish(Empty)
publish(Empty, Empty())
publish(Empty, Float32())
publish(Vector3, 1, 2, 3)
publish(Pose2D, x=1, theta=2)
publisher[Twist].unregister()
publisher[Twist].unregister()
attempt(publisher[Twist].publish, Twist())

#> ValueError topic name is not a non-empty string
#> ValueError topic parameter 'data_class' is not initialized
#> ValueError data_class [linear: x: 0.0 y: 0.0 z: 0.0 angular: x: 0.0 y: 0.0 z: 0.0] is not a class
#> ValueError ~name topics cannot be created before init_node() has been called
#> ROSException ROS node has not been initialized yet. Please call init_node() first
#> ValueError name must not be empty
#> ValueError namespaces are not allowed in node names
#> ROSInitException time is not initialized. Have you called init_node()?
#> [linear: x: 0.0 y: 0.0 z: 0.0 angular: x: 0.0 y: 0.0 z: 0.0]
#> [linear: x: 1.0 y: 0.0 z: 0.0 angular: x: 0.0 y: 0.0 z: 0.0]
#> [linear: x: 1.0 y: 0.0 z: 0.0 angular: x: 0.0 y: 0.0 z: 0.0]
#> [linear: x: 0.0 y: 0.0 z: 0.0 angular: x: 0.0 y: 0.0 z: 0.0]
#> TypeError Invalid number of arguments, args should be ['linear', 'angular'] args are(x: 0.0 y: 0.0 z: 0.0,)
#> TypeError Invalid number of arguments, args should be ['linear', 'angular'] args are(0.5,)
#> TypeError expected [geometry_msgs/Vector3] but got [std_msgs/Float32]
#> TypeError publish() can be called with arguments or keywords, but not both.
#> ROSSerializationException field linear.x must be float type
#> AttributeError 'int' object has no attribute 'x'
#> [data: 0.10000000149011612]
#> [data: 1.0]
#> [data: 1.0]
#> [data: 0.25]
#> AttributeError date is not an attribute of Float32
#> ROSSerializationException field data must be float type
#> [data: 0.1]
#> [data: 3]
#> ROSSerializationException field data must be an integer type
#> ROSSerializationException field data exceeds specified width [int32]
#> ROSSerializationException field data must be unsigned integer type
#> [data: True]
#> [data: "\xFC"]
#> ROSSerializationException field data must be of type bytes or an ascii string
#> []
#> []
#> TypeError expected [] but got [std_msgs/Float32]
#> [x: 1.0 y: 2.0 z: 3.0]
#> [x: 1.0 y: 0.0 theta: 2.0]
#> ROSException publish() to an unregistered() handle
