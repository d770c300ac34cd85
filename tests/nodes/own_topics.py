"""Topics between the parts of one program."""
import rospy
from std_msgs.msg import Float32, Float32MultiArray, String

rospy.init_node("own_topics")
heard = []


def wait_for(number):
    end = rospy.get_time() + 2
    while len(heard) < number and rospy.get_time() < end:
        rospy.sleep(0.01)
    print(heard)
    del heard[:]


def on_word(message, name):
    heard.append(name + message.data)


dark = rospy.Publisher("dark_x", Float32, queue_size=10)
first = rospy.Subscriber("/dark_x", Float32, lambda message: heard.append(message.data))
second = rospy.Subscriber("dark_x", Float32, lambda message: heard.append(-message.data))
private = rospy.Publisher("~word", String, queue_size=10, latch=True)
rospy.Subscriber("own_topics/word", String, on_word, "word: ")
while not (dark.get_num_connections() and private.get_num_connections() and first.get_num_connections()):
    rospy.sleep(0.01)
print(dark.name, private.resolved_name, dark.get_num_connections())
print(rospy.resolve_name("~x"), rospy.resolve_name("a//b/"))
for value in (0.5, 0.25):
    dark.publish(value)
    wait_for(2)
second.unregister()
dark.publish(0.125)
wait_for(1)
private.publish("hello")
wait_for(1)
late = rospy.Subscriber("~word", String, on_word, callback_args="late: ")
wait_for(1)
print(rospy.wait_for_message("~word", String, 1))
message = Float32MultiArray(data=[1, 2])
numbers = rospy.Publisher("numbers", Float32MultiArray, queue_size=1)
rospy.Subscriber("numbers", Float32MultiArray, heard.append)
while not numbers.get_num_connections():
    rospy.sleep(0.01)
numbers.publish(message)
message.data = [3]
wait_for(1)
print(rospy.Publisher("nobody", Float32, queue_size=1).get_num_connections())
try:
    rospy.wait_for_message("/dark_x", Float32, rospy.Duration(0.2))
except rospy.ROSException as error:
    print(error)

#> /dark_x /own_topics/word 1
#> /own_topics/x /a/b
#> [0.5, -0.5]
#> [0.25, -0.25]
#> [0.125]
#> ['word: hello']
#> ['late: hello']
#> data: "hello"
#> [layout:
#>   dim: []
#>   data_offset: 0
#> data: [1.0, 2.0]]
#> 0
#> timeout exceeded while waiting for message on topic /dark_x
