"""Loops that compute and do not wait: callbacks run meanwhile."""
import time

import rospy
from std_msgs.msg import Float32MultiArray

rospy.init_node("computing")
seen = []
subscriber = rospy.Subscriber("line", Float32MultiArray, seen.append)
while not rospy.is_shutdown() and not seen:
    pass
print(seen[0].data)
del seen[:]
while not seen:
    pass
for clock in (rospy.get_time, time.time, lambda: rospy.Time.now().to_sec(), time.monotonic, time.perf_counter):
    del seen[:]
    end = clock() + 0.2
    while clock() < end:
        pass
    print(len(seen) > 1)

#> (0.25, 0.5, 1.0)
#> True
#> True
#> True
#> True
#> True
