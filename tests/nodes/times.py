"""Times and durations: how they are made, calculated with, compared and printed."""
import rospy
from rospy import Duration, Time


def attempt(function):
    try:
        print(function())
    except (TypeError, ValueError) as error:
        print(type(error).__name__)


print(Time(), Time(1), Time(2, 500000000), Time(1.5), Time.from_sec(0.25), Time(0) == Time())
print(repr(Time(1.5)), repr(Duration(-0.5)), repr(Time(1, -1)), Duration(1, 2000000000))
print(Time(3) - Time(1.5), Time(3) - Duration(1), Time(3) + Duration(1.5), Duration(1) + Time(2))
print(Duration(1) + Duration(2), Duration(1) - Duration(2), -Duration(1.5), abs(Duration(-1.5)))
print(Duration(3) * 2, 2 * Duration(3), Duration(3) * 0.5, Duration(3) / 2, Duration(3) / Duration(2))
print(Duration(7) // Duration(2), Duration(7) // 2, Duration(7) % Duration(4))
print(Time(1) < Time(2), Time(2) <= Time(2), Time(1) > Time(2), Time(1) >= Time(2), Time(1) != Time(2))
print(Duration(1) < Duration(2), Duration(1) == Time(1), max(Duration(1), Duration(3)), bool(Duration()))
print(Time(1.5).to_sec(), Time(1, 5).to_nsec(), Time(1.5).secs, Time(1.5).nsecs, Duration(-0.25).secs)
print(Duration(2).is_zero(), Duration().is_zero(), {Time(1): "one"}[Time(1)], sorted([Time(3), Time(1)])[0])
time = Time()
time.set(3, 1500000000)
time.canon()
print(time.secs, time.nsecs)
attempt(lambda: Time(-1))
attempt(lambda: Time(1.5, 3))
attempt(lambda: Time(1) + Time(2))
attempt(lambda: Time(1) + 1)
attempt(lambda: Time(1) < Duration(2))
attempt(lambda: Duration(1) < 2)
attempt(lambda: Duration(1) - Time(2))

rospy.init_node("times")
start = rospy.Time.now()
rospy.sleep(rospy.Duration(0.1))
rospy.sleep(-1)
rospy.sleep(0)
print(round((rospy.Time.now() - start).to_sec(), 1), round(rospy.get_time() - start.to_sec(), 1))
print(rospy.get_rostime() > start, start.to_sec() > 1600000000)

#> 0 1000000000 2500000000 1500000000 250000000 True
#> rospy.Time[1500000000] rospy.Duration[-500000000] rospy.Time[999999999] 3000000000
#> 1500000000 2000000000 4500000000 3000000000
#> 3000000000 -1000000000 -1500000000 1500000000
#> 6000000000 6000000000 1500000000 1500000000 1.5
#> 3 3000000000 3000000000
#> True True False False True
#> True False 3000000000 False
#> 1.5 1000000005 1 500000000 -1
#> False True one 1000000000
#> 4 500000000
#> TypeError
#> ValueError
#> TypeError
#> TypeError
#> TypeError
#> TypeError
#> TypeError
#> 0.1 0.1
#> True True
