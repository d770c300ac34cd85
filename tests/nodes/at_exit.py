"""A node ends by itself: its last functions run, and a line without an end is shown."""
import rospy


def goodbye():
    print("goodbye", rospy.is_shutdown())


rospy.init_node("at_exit")
rospy.on_shutdown(goodbye)
print("a", "b", sep="-", end="; ")
print("c\nd", end="\n\n")
print()
print("x", 1.5)
print(None, True, [1, "a"], sep=", ")

#> a-b; c
#> d
#>
#>
#> x 1.5
#> None, True, [1, 'a']
#> goodbye False
