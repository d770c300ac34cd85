"""Messages: what they hold at first, how they are made, printed and compared, and what they refuse."""
from geometry_msgs.msg import Point, Pose, Pose2D, PoseStamped, Quaternion, Twist, TwistStamped, Vector3
from nav_msgs.msg import Odometry
from std_msgs.msg import Bool, ColorRGBA, Empty, Float32, Float32MultiArray, Header, Int32, MultiArrayDimension, String


def print_short(message):
    print(" ".join(str(message).split()))


def attempt(function, *args, **kwds):
    try:
        print(function(*args, **kwds))
    except (AttributeError, TypeError) as error:
        print(type(error).__name__, str(error).split(", args")[0].split(" and no")[0])  # Python 3.13 says more


print(Twist())
print_short(Twist(Vector3(1, 2.5, 0), Vector3(z=0.1)))
print(Twist(linear=Vector3(x=1)).linear.x, Twist(angular=None).angular.z)
print(Pose2D(1, 2, 3.25))
print(PoseStamped(Header(7, None, "map"), Pose(Point(1, 2, 3), Quaternion(0, 0, 0, 1))))
print(Float32(0.1), Float32(data=1), Int32(3), Bool(True), String("it's \"x\"\n\tü"), String(), repr(Empty()))
print(ColorRGBA(1, 0, 0.5, 1).g, TwistStamped().header.frame_id == "")
array = Float32MultiArray(data=[1, 2.5])
array.layout.dim.append(MultiArrayDimension("left", 1, 2))
print(array)
print_short(Float32MultiArray())
odometry = Odometry()
print(len(odometry.pose.covariance), odometry.pose.covariance[35], odometry.child_frame_id == "")
print(Twist() == Twist(), Twist() != Twist(), Twist(Vector3(1, 0, 0), Vector3()) == Twist(), Twist() == 1)
print(Float32MultiArray(data=[1, 2]) == Float32MultiArray(data=(1, 2)), Vector3(1, 2, 3) == Point(1, 2, 3))
twist = Twist()
twist.linear = Vector3(3, 2, 1)
print(twist.linear.y, Twist._type, Twist.__slots__, Odometry._slot_types[2])
attempt(Twist, Vector3())
attempt(Float32, 1, 2)
attempt(Twist, linaer=Vector3())
attempt(Twist, Vector3(), angular=Vector3())
attempt(setattr, twist, "x", 1)
attempt(setattr, twist.linear, "X", 1)
attempt(getattr, twist, "speed")

#> linear:
#>   x: 0.0
#>   y: 0.0
#>   z: 0.0
#> angular:
#>   x: 0.0
#>   y: 0.0
#>   z: 0.0
#> linear: x: 1 y: 2.5 z: 0 angular: x: 0.0 y: 0.0 z: 0.1
#> 1 0.0
#> x: 1
#> y: 2
#> theta: 3.25
#> header:
#>   seq: 7
#>   stamp:
#>     secs: 0
#>     nsecs:         0
#>   frame_id: "map"
#> pose:
#>   position:
#>     x: 1
#>     y: 2
#>     z: 3
#>   orientation:
#>     x: 0
#>     y: 0
#>     z: 0
#>     w: 1
#> data: 0.1 data: 1 data: 3 data: True data: "it's \"x\"\n\t\xFC" data: ''
#> 0 True
#> layout:
#>   dim:
#>     -
#>       label: "left"
#>       size: 1
#>       stride: 2
#>   data_offset: 0
#> data: [1, 2.5]
#> layout: dim: [] data_offset: 0 data: []
#> 36 0.0 True
#> True False False False
#> True False
#> 2 geometry_msgs/Twist ['linear', 'angular'] geometry_msgs/PoseWithCovariance
#> TypeError Invalid number of arguments
#> TypeError Invalid number of arguments
#> AttributeError linaer is not an attribute of Twist
#> TypeError Message constructor may only use args OR keywords, not both
#> AttributeError 'Twist' object has no attribute 'x'
#> AttributeError 'Vector3' object has no attribute 'X'
#> AttributeError 'Twist' object has no attribute 'speed'
