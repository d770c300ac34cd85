"""Parameters and names."""
import sys

import rospy

rospy.init_node("parameters")
rospy.init_node("parameters")
print(rospy.get_param("~speed", 0.5), rospy.get_param("speed", None), rospy.get_param("~x", default=""))
for read in (rospy.get_param, rospy.delete_param):
    try:
        print(read("~speed"))
    except KeyError as error:
        print("KeyError", "speed" in str(error))
rospy.set_param("~speed", 0.25)
rospy.set_param("/names", ["red", "blue"])
print(rospy.get_param("~speed"), rospy.get_param("/parameters/speed", 1), rospy.has_param("~speed"))
print(rospy.has_param("x"), rospy.get_param("names"))
rospy.delete_param("~speed")
rospy.delete_param("/names")
print(rospy.get_param("~speed", "gone"))
print(rospy.get_name(), rospy.get_caller_id(), rospy.get_namespace(), len(rospy.myargv()), len(sys.argv))
print(rospy.myargv(["a", "b:=c", "d"]))
try:
    rospy.init_node("other")
except rospy.exceptions.ROSException as error:
    print(str(error).split(":")[0])

#> 0.5 None
#> KeyError True
#> KeyError True
#> 0.25 0.25 True
#> False ['red', 'blue']
#> gone
#> /parameters /parameters / 1 1
#> ['a', 'd']
#> rospy.init_node() has already been called with different arguments
