// What the Python of the robot's blocks needs beside its own lines.

const STOP = "motion.linear.x = motion.angular.z = 0";

const NAME = /^(?:(?:from \S+ )?import |def |global )?(\w+)/; // that a line brings

// imports; code; start: what main() does first
export const HELPERS = {
  wait: {
    code: `def wait(seconds):
    """Repeat the command ten times per second."""
    end = rospy.get_time() + seconds
    while rospy.get_time() < end:
        publisher.publish(motion)
        rospy.sleep(min(0.1, end - rospy.get_time()))`,
  },
  drive: {
    code: `def drive(x, z, seconds):
    motion.linear.x = x
    motion.angular.z = z
    wait(seconds)
    ${STOP}`,
  },
  stop: {
    code: `def stop():
    ${STOP}
    publisher.publish(motion)`,
  },
  wheels: {
    code: `def set_wheels(left, right):
    motion.linear.x = (left + right) / 2%speed
    motion.angular.z = (right - left) / %separation%speed`,
  },
  counting: {
    code: `def counting(start, end, step):
    """Count from start to end, up or down."""
    if step == 0:
        raise ValueError("This loop counts by 0, and never arrives.")
    sign = 1 if start <= end else -1
    while sign * start <= sign * end:
        yield start
        start += sign * abs(step)`,
  },
  random_integer: {
    imports: ["import random"],
    code: `def random_integer(one, other):
    low, high = sorted([round(one), round(other)])
    return random.randint(low, high)`,
  },
  seconds: {
    code: `def seconds():
    return rospy.get_time() - beginning`,
    start: ["global beginning", "beginning = rospy.get_time()"],
  },
  here: {
    imports: ["import math", "from geometry_msgs.msg import Pose2D", "from nav_msgs.msg import Odometry"],
    code: `here = Pose2D()  # seen from where the program starts: m, m, rad
origin = []


def on_odom(message):
    position, rotation = message.pose.pose.position, message.pose.pose.orientation
    x, y, yaw = position.x, position.y, 2 * math.atan2(rotation.z, rotation.w)
    origin[:] = origin or (x, y, yaw)
    ahead, left, cosine, sine = x - origin[0], y - origin[1], math.cos(origin[2]), math.sin(origin[2])
    here.x, here.y = ahead * cosine + left * sine, left * cosine - ahead * sine
    here.theta = math.remainder(yaw - origin[2], math.tau)`,
    start: ['on_odom(rospy.wait_for_message("odom", Odometry, 5))', 'rospy.Subscriber("odom", Odometry, on_odom)'],
  },
  eyes: {
    imports: ["from std_msgs.msg import Float32MultiArray"],
    code: `eyes = [1, 1, 1]  # left, middle, right: 0 on a line


def on_line(message):
    eyes[:] = message.data`,
    start: ['on_line(rospy.wait_for_message("line", Float32MultiArray, 5))',
      'rospy.Subscriber("line", Float32MultiArray, on_line)'],
  },
  duties: {
    imports: ["from std_msgs.msg import Float32MultiArray"],
    code: `wheels = [0, 0]  # left, right: what they get


def on_wheels(message):
    wheels[:] = message.data[2:]`,
    start: ['rospy.Subscriber("jetbot_controller/wheels", Float32MultiArray, on_wheels)'],
  },
};

// The names that all of this uses: a person's variables get others.
export const NAMES = Object.values(HELPERS).flatMap(({ imports = [], code, start = [] }) =>
  [...imports, ...code.split("\n"), ...start].map((line) => NAME.exec(line)?.[1]).filter(Boolean));
