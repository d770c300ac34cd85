"""What publish() takes, and what it refuses."""
import rospy
from geometry_msgs.msg import Pose2D, PoseStamped, Twist, Vector3
from std_msgs.msg import Bool, Empty, Float32, Float64, Int32, String, UInt8


def attempt(function, *args, **kwds):
    try:
        function(*args, **kwds)
        print("published")
    except (AttributeError, TypeError, ValueError, rospy.ROSException) as error:
        print(type(error).__name__, error)


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
while not all([each.get_num_connections() for each in publisher.values()]):
    rospy.sleep(0.01)


def publish(topic, *args, **kwds):
    del received[:]
    attempt(publisher[topic].publish, *args, **kwds)
    end = rospy.get_time() + 0.1
    while not received and rospy.get_time() < end:
        rospy.sleep(0.01)
    print(received)


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
publish(Float32, "much")
publish(Float32, data=0.25)
publish(Float32, date=0.25)
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
