"""Timers run beside the program, until it ends or they are shut down."""
import rospy

rospy.init_node("timers")
ticks, events = [], []
start = rospy.get_time()


def tick(event):
    events.append(event)
    ticks.append(round(rospy.get_time() - start, 1))


timer = rospy.Timer(rospy.Duration(0.2), tick)
rospy.Timer(rospy.Duration(0.5), lambda event: ticks.append("once"), oneshot=True)
rospy.sleep(0.9)
timer.shutdown()
print(ticks)
first, second = events[:2]
print(first.last_real, first.last_expected, first.last_duration, round(first.current_expected.to_sec() - start, 1))
print(second.last_real == first.current_real, second.last_expected == first.current_expected)
print(round((second.current_expected - second.last_expected).to_sec(), 1), second.last_duration < 0.1)
rospy.sleep(0.5)
print(len(ticks))

#> [0.2, 0.4, 'once', 0.6, 0.8]
#> None None None 0.2
#> True True
#> 0.2 True
#> 5
