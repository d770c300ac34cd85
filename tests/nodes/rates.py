"""Rate: it evens out what the loop takes, and lets a loop that is too slow go on at once."""
import time

import rospy

rospy.init_node("rates")
rate = rospy.Rate(5)
print(round(rate.remaining().to_sec(), 1), rate.sleep_dur, rospy.Rate(30).sleep_dur)
start = rospy.get_time()
for _ in range(3):
    rospy.sleep(0.1)
    rate.sleep()
print(round(rospy.get_time() - start, 1))
rospy.sleep(0.3)
print(round(rate.remaining().to_sec(), 1))
rate.sleep()  # late by 0.1 s: at once
print(round(rospy.get_time() - start, 1))
rate.sleep()  # catches up
print(round(rospy.get_time() - start, 1))
start = rospy.get_time()
rospy.sleep(1)  # too much to catch up with
rate.sleep()
rate.sleep()
print(round(rospy.get_time() - start, 1))
start = time.time(), time.monotonic(), time.perf_counter()
time.sleep(0.2)
print([round(now - then, 1) for now, then in zip((time.time(), time.monotonic(), time.perf_counter()), start)])
try:
    time.sleep(-1)
except ValueError as error:
    print(error)

#> 0.2 200000000 33333333
#> 0.6
#> -0.1
#> 0.9
#> 1.0
#> 1.2
#> [0.2, 0.2, 0.2]
#> sleep length must be non-negative
